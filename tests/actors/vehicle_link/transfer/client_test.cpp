#include "actors/vehicle_link/transfer/client.hpp"

#include <gtest/gtest.h>

#include "actors/vehicle_link/transfer/plan_reader.hpp"
#include "tests/support/time_units.hpp"
#include "tests/support/transfer_world.hpp"

namespace godwit::tests {
namespace client_test {

namespace mavlink = io::mavlink;
using mavlink::mav_autopilot;
using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;
using transfer::verdict;

using godwit::tests::ms;

transfer::client px4_client() { return {our_id, vehicle_id, transfer::profile_for(mav_autopilot::px4), 0}; }

template <class M>
M to_us(M message) {
  message.target_system = our_id.system;
  message.target_component = our_id.component;
  return message;
}

mavlink::mission_ack refusal() {
  mavlink::mission_ack ack;
  ack.type = number(mav_mission_result::no_space);
  return ack;
}

TEST(client, is_idle_before_and_after_a_transfer) {
  auto client = px4_client();
  EXPECT_TRUE(client.is_idle());
  EXPECT_EQ(client.next_deadline_ns(), std::nullopt);
  (void)client.upload(mav_mission_type::mission, mission_of(3), ms);
  EXPECT_FALSE(client.is_idle());
  const auto out = client.cancel(2 * ms);
  EXPECT_TRUE(out.finished.has_value());
  EXPECT_TRUE(client.is_idle());
}

TEST(client, ignores_what_is_for_others_or_of_another_type) {
  auto client = px4_client();
  (void)client.upload(mav_mission_type::mission, mission_of(3), ms);
  auto others = refusal();
  others.target_system = other_station_id.system;
  others.target_component = other_station_id.component;
  auto fences = to_us(refusal());
  fences.mission_type = number(mav_mission_type::fence);
  (void)client.on(others, 2 * ms);
  (void)client.on(fences, 2 * ms);
  EXPECT_EQ(client.ignored(), 2U);
  const auto out = client.on_time(*client.next_deadline_ns());
  EXPECT_FALSE(out.finished.has_value());
}

TEST(client, ignores_everything_when_nothing_is_going_on) {
  auto client = px4_client();
  EXPECT_TRUE(client.on(to_us(mavlink::mission_request_int{}), ms).messages.empty());
  EXPECT_TRUE(client.on(to_us(mavlink::mission_count{}), ms).messages.empty());
  EXPECT_TRUE(client.on(to_us(refusal()), ms).messages.empty());
  EXPECT_EQ(client.ignored(), 3U);
  EXPECT_FALSE(client.cancel(ms).finished.has_value());
}

TEST(client, answers_both_kinds_of_request_alike) {
  for (const bool deprecated : {false, true}) {
    auto client = px4_client();
    (void)client.upload(mav_mission_type::mission, mission_of(3), ms);
    const auto out = deprecated ? client.on(to_us(mavlink::mission_request{}), 31 * ms)
                                : client.on(to_us(mavlink::mission_request_int{}), 31 * ms);
    ASSERT_FALSE(out.messages.empty());
    EXPECT_TRUE(std::holds_alternative<mavlink::mission_item_int>(out.messages.front()));
  }
}

TEST(client, repeats_a_cancel_to_a_vehicle_that_still_asks_and_not_for_ever) {
  auto client = px4_client();
  (void)client.upload(mav_mission_type::mission, mission_of(3), ms);
  (void)client.cancel(2 * ms);
  int repeats = 0;
  for (int i = 0; i < 50; ++i)
    repeats += static_cast<int>(client.on(to_us(mavlink::mission_request_int{}), (3 + i) * ms).messages.size());
  EXPECT_EQ(repeats, transfer::max_cancel_repeats);
}

TEST(client, cancels_an_upload_of_another_type_that_the_vehicle_still_asks_for_and_nothing_else) {
  auto client = px4_client();
  auto stale = to_us(mavlink::mission_request_int{});
  stale.mission_type = number(mav_mission_type::fence);
  EXPECT_TRUE(client.on(stale, ms).messages.empty()) << "nothing of ours runs";
  (void)client.upload(mav_mission_type::mission, mission_of(3), ms);
  EXPECT_TRUE(client.on(stale, 500 * ms).messages.empty()) << "it may be a late one";
  auto anybodys = stale;
  anybodys.target_system = 0;
  EXPECT_TRUE(client.on(anybodys, 1'500 * ms).messages.empty());
  const auto out = client.on(stale, 1'500 * ms);
  ASSERT_EQ(out.messages.size(), 1U);
  const auto& told = std::get<mavlink::mission_ack>(out.messages.front());
  EXPECT_EQ(told.type, number(mavlink::mav_mission_result::operation_cancelled));
  EXPECT_EQ(told.mission_type, number(mav_mission_type::fence));
  (void)client.on(to_us(mavlink::mission_request_int{}), 1'600 * ms);
  EXPECT_TRUE(client.on(stale, 1'700 * ms).messages.empty()) << "it has begun with ours";
}

TEST(client, does_not_begin_an_upload_while_frames_of_the_last_one_may_be_on_the_line) {
  auto client = px4_client();
  (void)client.upload(mav_mission_type::mission, mission_of(3), ms);
  (void)client.cancel(2 * ms);
  auto out = client.upload(mav_mission_type::mission, mission_of(4), 3 * ms);
  EXPECT_TRUE(out.messages.empty());
  ASSERT_EQ(client.next_deadline_ns(), 2 * ms + transfer::frames_stay_ns);
  (void)client.on(to_us(mavlink::mission_request_int{}), 4 * ms);
  out = client.on_time(*client.next_deadline_ns());
  ASSERT_EQ(out.messages.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<mavlink::mission_count>(out.messages.front()));
}

TEST(client, uploads_of_another_type_do_not_wait) {
  auto client = px4_client();
  (void)client.upload(mav_mission_type::mission, mission_of(3), ms);
  (void)client.cancel(2 * ms);
  EXPECT_EQ(client.upload(mav_mission_type::fence, mission_of(3), 3 * ms).messages.size(), 1U);
}

TEST(client, a_plan_that_can_not_be_counted_is_refused_without_sending) {
  auto client = px4_client();
  const auto out = client.upload(mav_mission_type::mission, mission_of(transfer::plan_reader::max_items + 1), ms);
  ASSERT_TRUE(out.finished.has_value());
  EXPECT_EQ(out.finished->verdict, verdict::refused);
  EXPECT_TRUE(out.messages.empty());
  EXPECT_TRUE(client.is_idle());
}

TEST(client, two_at_a_time_are_a_broken_invariant) {
  auto client = px4_client();
  (void)client.upload(mav_mission_type::mission, mission_of(3), ms);
  EXPECT_DEATH((void)client.download(mav_mission_type::mission, 2 * ms), "none is running");
}

TEST(client, an_identical_plan_is_accepted_though_its_id_does_not_change) {
  transfer_world world(mission_server::px4_profile(), transfer::profile_for(mav_autopilot::px4), {}, 1);
  world.report_mission_every_second();
  const auto plan = mission_of(20);
  for (int i = 0; i < 3; ++i) {
    const auto outcome = world.upload(plan);
    EXPECT_EQ(outcome.verdict, verdict::accepted);
    EXPECT_EQ(outcome.plan_id, world.vehicle().plan(mav_mission_type::mission).id);
    world.run_for(3'000 * ms);
  }
}

TEST(client, what_was_learned_of_the_line_serves_the_next_transfer) {
  transfer_world world(mission_server::px4_profile(), transfer::profile_for(mav_autopilot::px4), {}, 1);
  (void)world.upload(mission_of(20));
  world.run_for(2'000 * ms);
  world.ours().drops_sent = [lost = 0](const transfer::outgoing& each) mutable {
    return std::holds_alternative<mavlink::mission_count>(each) && lost++ == 0;
  };
  const auto outcome = world.upload(mission_of(20, 1));
  EXPECT_EQ(outcome.verdict, verdict::accepted);
  EXPECT_LT(outcome.duration_ns, 200 * ms) << "the lost announcement was missed after a round trip";
}

} // namespace client_test
} // namespace godwit::tests
