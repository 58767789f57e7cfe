#include "actors/vehicle_link/transfer/upload.hpp"

#include <gtest/gtest.h>

#include "tests/support/time_units.hpp"
#include "tests/support/transfer_world.hpp"

namespace godwit::tests {
namespace upload_test {

namespace mavlink = io::mavlink;
using mavlink::mav_autopilot;
using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;
using transfer::holding;
using transfer::proof;
using transfer::verdict;

using godwit::tests::ms;

transfer_world px4_world(const line_settings& line = {}) {
  return {mission_server::px4_profile(), transfer::profile_for(mav_autopilot::px4), line, 1};
}

transfer_world copter_world(const line_settings& line = {}) {
  return {mission_server::ardupilot_copter_profile(), transfer::profile_for(mav_autopilot::ardupilotmega), line, 1};
}

transfer_world unknown_world() {
  return {mission_server::plain_profile(), transfer::profile_for(mav_autopilot::generic), {}, 1};
}

template <class M>
auto drop_first(int count) {
  return [left = count](const auto& each) mutable { return std::holds_alternative<M>(each) && left-- > 0; };
}

auto drop_acks_of(mav_mission_result result, int count) {
  return [result, left = count](const mission_server::outgoing& each) mutable {
    const auto* ack = std::get_if<mavlink::mission_ack>(&each);
    return ack != nullptr && ack->type == number(result) && left-- > 0;
  };
}

int count_sent_items(transfer_world& world) { return static_cast<int>(world.ours().outcomes.back().effort.items_sent); }

TEST(upload, each_kind_of_vehicle_holds_the_plan_and_each_item_was_sent_once) {
  const auto plan = mission_of(50);
  for (auto make : {+[] { return px4_world(); }, +[] { return copter_world(); }, +[] { return unknown_world(); }}) {
    auto world = make();
    const auto outcome = world.upload(plan);
    EXPECT_EQ(outcome.verdict, verdict::accepted);
    EXPECT_EQ(outcome.proof, proof::acknowledged);
    EXPECT_EQ(outcome.holding, holding::this_plan);
    EXPECT_TRUE(holds(world.vehicle(), plan));
    EXPECT_EQ(count_sent_items(world), 50);
    EXPECT_EQ(outcome.reason, "");
  }
}

// ArduCopter 4.7, at a replan: COUNT and eight items, REQUEST 1 to 7 and the ACK 5 ms later, and COUNT again.
TEST(upload, each_plan_is_sent_once_to_an_ardupilot_that_never_asks_for_item_0) {
  auto world = copter_world();
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto plan = mission_of(8, seed);
    EXPECT_EQ(world.upload(plan).verdict, verdict::accepted);
    EXPECT_EQ(count_sent_items(world), 8);
    EXPECT_TRUE(holds(world.vehicle(), plan));
  }
}

// Of an earlier life it may have had one open: then it could be a mixture that it has acknowledged.
TEST(upload, the_first_plan_of_a_life_is_read_back_and_not_sent_again) {
  auto world = copter_world();
  world.restart_our_client();
  const auto plan = mission_of(8);
  const auto outcome = world.upload(plan);
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_EQ(outcome.proof, proof::read_back);
  EXPECT_EQ(outcome.effort.items_sent, 8U);
  EXPECT_TRUE(holds(world.vehicle(), plan));
}

TEST(upload, items_carry_number_address_and_type) {
  auto world = px4_world();
  std::vector<mavlink::mission_item_int> sent;
  world.ours().drops_sent = [&](const transfer::outgoing& each) {
    if (const auto* item = std::get_if<mavlink::mission_item_int>(&each))
      sent.push_back(*item);
    return false;
  };
  auto fence = mission_of(3);
  for (auto& each : fence)
    each.command = number(mavlink::mav_cmd::nav_fence_circle_inclusion);
  EXPECT_EQ(world.upload(fence, mav_mission_type::fence).verdict, verdict::accepted);
  ASSERT_EQ(sent.size(), 3U);
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_EQ(sent[i].seq, i);
    EXPECT_EQ(sent[i].target_system, vehicle_id.system);
    EXPECT_EQ(sent[i].target_component, vehicle_id.component);
    EXPECT_EQ(sent[i].mission_type, number(mav_mission_type::fence));
  }
}

TEST(upload, to_an_unknown_vehicle_sends_no_item_before_it_is_asked_for) {
  auto world = unknown_world();
  int asked_for = 0;
  world.ours().drops_received = [&](const mission_server::outgoing& each) {
    if (std::holds_alternative<mavlink::mission_request_int>(each))
      ++asked_for;
    return false;
  };
  world.ours().drops_sent = [&](const transfer::outgoing& each) {
    const auto* item = std::get_if<mavlink::mission_item_int>(&each);
    EXPECT_TRUE(item == nullptr || item->seq < asked_for);
    return false;
  };
  EXPECT_EQ(world.upload(mission_of(20)).verdict, verdict::accepted);
}

TEST(upload, progress_goes_up_to_the_last_item) {
  auto world = px4_world();
  (void)world.upload(mission_of(20));
  int last = 0;
  for (const auto& each : world.ours().progress) {
    EXPECT_GE(each.done, last);
    EXPECT_EQ(each.total, 20);
    last = each.done;
  }
  EXPECT_EQ(last, 20);
}

TEST(upload, a_lost_announcement_is_repeated) {
  for (auto make : {+[] { return px4_world(); }, +[] { return copter_world(); }, +[] { return unknown_world(); }}) {
    auto world = make();
    world.ours().drops_sent = drop_first<mavlink::mission_count>(2);
    const auto plan = mission_of(20);
    EXPECT_EQ(world.upload(plan).verdict, verdict::accepted);
    EXPECT_TRUE(holds(world.vehicle(), plan));
  }
}

TEST(upload, px4_says_again_that_it_has_accepted) {
  auto world = px4_world();
  world.ours().drops_received = drop_acks_of(mav_mission_result::accepted, 1);
  const auto outcome = world.upload(mission_of(20));
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_EQ(outcome.proof, proof::acknowledged);
}

TEST(upload, a_lost_acknowledgement_of_ardupilot_is_settled_by_reading_back) {
  auto world = copter_world();
  world.ours().drops_received = drop_acks_of(mav_mission_result::accepted, 1);
  const auto outcome = world.upload(mission_of(20));
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_EQ(outcome.proof, proof::read_back);
  EXPECT_GT(outcome.effort.warnings, 0U) << "ERROR for the repeated last item, although the plan is stored";
  EXPECT_TRUE(world.vehicle().is_idle() || world.vehicle().is_giving());
}

TEST(upload, acknowledgements_that_never_come_are_settled_by_the_plan_id_where_there_is_one) {
  auto world = px4_world();
  world.report_mission_every_second();
  world.run_for(1'500 * ms);
  world.ours().drops_received = drop_acks_of(mav_mission_result::accepted, 1'000);
  const auto outcome = world.upload(mission_of(1'500)); // so long that the old id is told on the way
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_EQ(outcome.proof, proof::plan_id);
  EXPECT_EQ(outcome.plan_id, world.vehicle().plan(mav_mission_type::mission).id);
}

TEST(upload, a_new_plan_id_is_no_proof_where_the_old_one_was_not_told_while_the_vehicle_took_the_plan) {
  auto world = px4_world();
  world.report_mission_every_second();
  world.run_for(1'500 * ms);
  world.ours().drops_received = drop_acks_of(mav_mission_result::accepted, 1'000);
  const auto outcome = world.upload(mission_of(20));
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_EQ(outcome.proof, proof::read_back);
}

TEST(upload, an_acknowledgement_without_a_request_for_the_last_item_is_settled_by_the_count) {
  auto world = copter_world();
  world.ours().drops_received = [](const mission_server::outgoing& each) {
    const auto* request = std::get_if<mavlink::mission_request>(&each);
    return request != nullptr && request->seq == 19;
  };
  const auto outcome = world.upload(mission_of(20));
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_EQ(outcome.proof, proof::counted);
  EXPECT_EQ(outcome.phase, transfer::phase::resolving);
}

TEST(upload, invalid_sequence_of_ardupilot_is_a_warning) {
  auto world = copter_world();
  world.ours().drops_sent = [dropped = false](const transfer::outgoing& each) mutable {
    const auto* item = std::get_if<mavlink::mission_item_int>(&each);
    if (item == nullptr || item->seq != 5 || dropped)
      return false;
    return dropped = true;
  };
  const auto plan = mission_of(30);
  const auto outcome = world.upload(plan);
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_GT(outcome.effort.warnings, 0U);
  EXPECT_EQ(outcome.effort.restarts, 0U);
  EXPECT_TRUE(holds(world.vehicle(), plan));
}

TEST(upload, a_plan_without_room_is_refused_and_the_old_one_stays) {
  for (auto make : {+[] { return px4_world(); }, +[] { return copter_world(); }}) {
    auto world = make();
    const auto old_plan = mission_of(5, 7);
    ASSERT_EQ(world.upload(old_plan).verdict, verdict::accepted);
    const auto outcome = world.upload(mission_of(3'000));
    EXPECT_EQ(outcome.verdict, verdict::refused);
    EXPECT_EQ(outcome.result, number(mav_mission_result::no_space));
    EXPECT_EQ(outcome.holding, holding::unchanged);
    EXPECT_NE(outcome.reason, "");
    EXPECT_TRUE(holds(world.vehicle(), old_plan));
  }
}

TEST(upload, a_refused_item_is_named_and_an_atomic_vehicle_keeps_the_old_plan) {
  auto world = px4_world();
  const auto old_plan = mission_of(5, 7);
  ASSERT_EQ(world.upload(old_plan).verdict, verdict::accepted);
  auto plan = mission_of(30);
  plan[12].command = 9'999;
  const auto outcome = world.upload(plan);
  EXPECT_EQ(outcome.verdict, verdict::refused);
  EXPECT_EQ(outcome.result, number(mav_mission_result::unsupported));
  EXPECT_EQ(outcome.item, 12);
  EXPECT_EQ(outcome.holding, holding::unchanged);
  EXPECT_TRUE(holds(world.vehicle(), old_plan));
}

TEST(upload, after_a_refusal_ardupilot_is_asked_how_much_it_holds) {
  auto world = copter_world();
  ASSERT_EQ(world.upload(mission_of(20, 7)).verdict, verdict::accepted);
  auto plan = mission_of(30);
  plan[12].x = 950'000'000;
  const auto outcome = world.upload(plan);
  EXPECT_EQ(outcome.verdict, verdict::refused);
  EXPECT_EQ(outcome.result, number(mav_mission_result::invalid_param5_x));
  EXPECT_EQ(outcome.item, 12);
  EXPECT_EQ(outcome.holding, holding::unknown) << "it replaces item by item";
  EXPECT_EQ(outcome.items_on_vehicle, world.vehicle().plan(mav_mission_type::mission).items.size());
}

TEST(upload, a_vehicle_that_is_not_there_is_given_its_patience) {
  auto world = px4_world();
  world.ours().line.cut(true);
  const auto outcome = world.upload(mission_of(5));
  EXPECT_EQ(outcome.verdict, verdict::timed_out);
  EXPECT_EQ(outcome.phase, transfer::phase::announcing);
  EXPECT_EQ(outcome.holding, holding::unchanged);
  EXPECT_GE(outcome.duration_ns, 5'000 * ms);
  EXPECT_LE(outcome.duration_ns, 7'000 * ms);
}

TEST(upload, a_line_that_breaks_in_the_middle_ends_with_the_phase_and_what_is_known) {
  auto world = copter_world();
  world.begin(world.ours(),
              world.ours().client.upload(mav_mission_type::mission, mission_of(100), world.time().now_ns()));
  world.run_for(100 * ms);
  world.ours().line.cut(true);
  ASSERT_TRUE(world.run_until_idle(world.ours()));
  const auto outcome = world.ours().outcomes.back();
  EXPECT_EQ(outcome.verdict, verdict::timed_out);
  EXPECT_EQ(outcome.phase, transfer::phase::sending);
  EXPECT_EQ(outcome.holding, holding::unknown);
}

TEST(upload, a_break_shorter_than_the_patience_is_survived_and_a_longer_one_begins_again) {
  for (const auto& [break_ms, restarts] : {std::pair{3'000, 0U}, std::pair{8'000, 1U}}) {
    auto world = px4_world();
    const auto plan = mission_of(100);
    world.begin(world.ours(), world.ours().client.upload(mav_mission_type::mission, plan, world.time().now_ns()));
    world.run_for(70 * ms);
    world.ours().line.cut(true);
    world.run_for(break_ms * ms);
    world.ours().line.cut(false);
    ASSERT_TRUE(world.run_until_idle(world.ours()));
    const auto outcome = world.ours().outcomes.back();
    EXPECT_EQ(outcome.verdict, verdict::accepted);
    EXPECT_EQ(outcome.effort.restarts, restarts);
    EXPECT_TRUE(holds(world.vehicle(), plan));
  }
}

TEST(upload, an_open_transfer_of_an_earlier_life_is_not_continued_with_other_items) {
  for (auto make : {+[] { return px4_world(); }, +[] { return copter_world(); }, +[] { return unknown_world(); }}) {
    auto world = make();
    world.begin(world.ours(),
                world.ours().client.upload(mav_mission_type::mission, mission_of(40, 1), world.time().now_ns()));
    world.run_for(50 * ms);
    world.ours().line.cut(true);
    world.restart_our_client();
    world.run_for(1'000 * ms);
    world.ours().line.cut(false);
    world.ours().outcomes.clear();
    world.ours().drops_sent = drop_first<mavlink::mission_count>(1);
    const auto plan = mission_of(40, 2);
    EXPECT_EQ(world.upload(plan).verdict, verdict::accepted);
    EXPECT_TRUE(holds(world.vehicle(), plan));
  }
}

TEST(upload, an_open_transfer_of_ours_that_failed_is_not_continued_with_other_items) {
  auto world = copter_world();
  world.begin(world.ours(),
              world.ours().client.upload(mav_mission_type::mission, mission_of(40, 1), world.time().now_ns()));
  world.run_for(20 * ms);
  ASSERT_TRUE(world.vehicle().is_receiving());
  world.begin(world.ours(), world.ours().client.cancel(world.time().now_ns()));
  world.run_for(1'000 * ms);
  world.ours().outcomes.clear();
  world.ours().drops_sent = drop_first<mavlink::mission_count>(1);
  world.ours().drops_received = drop_acks_of(mav_mission_result::invalid_sequence, 100);
  const auto plan = mission_of(40, 2);
  EXPECT_EQ(world.upload(plan).verdict, verdict::accepted);
  EXPECT_TRUE(holds(world.vehicle(), plan));
}

TEST(upload, waits_for_a_vehicle_that_is_busy_with_another_station) {
  for (auto make : {+[] { return px4_world(); }, +[] { return copter_world(); }}) {
    auto world = make();
    auto& other = world.add_station(other_station_id, {});
    world.begin(other, other.client.upload(mav_mission_type::mission, mission_of(200, 3), world.time().now_ns()));
    world.run_for(50 * ms);
    const auto plan = mission_of(20);
    EXPECT_EQ(world.upload(plan).verdict, verdict::accepted);
    EXPECT_TRUE(holds(world.vehicle(), plan));
    EXPECT_EQ(other.outcomes.back().verdict, verdict::accepted);
  }
}

TEST(upload, cancelled_before_the_last_item_left_changes_nothing_on_an_atomic_vehicle_and_stops_it) {
  auto world = px4_world();
  const auto old_plan = mission_of(5, 7);
  ASSERT_EQ(world.upload(old_plan).verdict, verdict::accepted);
  world.run_for(2'000 * ms);
  world.begin(world.ours(),
              world.ours().client.upload(mav_mission_type::mission, mission_of(500), world.time().now_ns()));
  world.run_for(100 * ms);
  world.begin(world.ours(), world.ours().client.cancel(world.time().now_ns()));
  EXPECT_EQ(world.ours().outcomes.back().verdict, verdict::cancelled);
  EXPECT_EQ(world.ours().outcomes.back().holding, holding::unchanged);
  world.run_for(100 * ms);
  EXPECT_TRUE(world.vehicle().is_idle());
  EXPECT_TRUE(holds(world.vehicle(), old_plan));
}

TEST(upload, cancelled_towards_ardupilot_stays_quiet_while_that_goes_on_asking) {
  auto world = copter_world();
  world.begin(world.ours(),
              world.ours().client.upload(mav_mission_type::mission, mission_of(500), world.time().now_ns()));
  world.run_for(100 * ms);
  world.begin(world.ours(), world.ours().client.cancel(world.time().now_ns()));
  EXPECT_EQ(world.ours().outcomes.back().verdict, verdict::cancelled);
  EXPECT_EQ(world.ours().outcomes.back().holding, holding::unknown);
  int sent = 0;
  world.ours().drops_sent = [&](const auto&) { return ++sent > 0; };
  world.run_for(20'000 * ms);
  EXPECT_EQ(sent, 0);
  EXPECT_TRUE(world.vehicle().is_idle()) << "it has given up by itself";
}

TEST(upload, a_line_much_slower_than_the_first_guess_is_not_flooded) {
  auto world = px4_world({.delay_ns = 400 * ms});
  const auto plan = mission_of(50);
  const auto outcome = world.upload(plan);
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_LE(outcome.effort.items_resent, 100U) << "the first guess of the round trip is a quarter of it";
}

} // namespace upload_test
} // namespace godwit::tests
