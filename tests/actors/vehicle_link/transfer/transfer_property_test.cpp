// Transfers over lines that lose, double, overtake and delay frames, with vehicles of every habit, and what goes wrong
// in between: whatever happens, the transfer ends, and what it says is true.
//
// Each case is made from one number, which RapidCheck prints when it fails, with the text to run it again (RC_PARAMS).
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <algorithm>

#include "io/mavlink/plan_meaning.hpp"
#include "tests/support/test_rng.hpp"
#include "tests/support/time_units.hpp"
#include "tests/support/transfer_world.hpp"

namespace godwit::tests {
namespace transfer_property_test {

namespace mavlink = io::mavlink;
using mavlink::mav_autopilot;
using mavlink::mav_mission_type;
using transfer::holding;
using transfer::verdict;

using godwit::tests::ms;

struct peer {
  mission_server::server_profile vehicle;
  transfer::peer_profile profile;
};

// Of some MAVLink servers: they say nothing where others acknowledge.
mission_server::server_profile taciturn_profile() {
  auto result = mission_server::plain_profile();
  result.when_out_of_order = mission_server::out_of_order::ignored;
  result.when_last_item_comes_again = mission_server::last_item_again::ignored;
  result.when_no_transfer = mission_server::stray_item::ignored;
  result.when_busy = std::nullopt;
  result.obeys_cancel = false;
  result.has_plan_ids = false;
  result.asks_again_ns = 500 * ms;
  return result;
}

peer any_peer(test_rng& draw) {
  switch (draw.between(0, 5)) {
  case 0:
  case 1:
    return {mission_server::px4_profile(), transfer::profile_for(mav_autopilot::px4)};
  case 2:
    return {mission_server::ardupilot_copter_profile(), transfer::profile_for(mav_autopilot::ardupilotmega)};
  case 3:
    return {mission_server::ardupilot_rover_profile(), transfer::profile_for(mav_autopilot::ardupilotmega)};
  case 4:
    return {mission_server::plain_profile(), transfer::profile_for(mav_autopilot::generic)};
  default:
    return {taciturn_profile(), transfer::profile_for(mav_autopilot::generic)};
  }
}

// Where no more is lost than this, it is not by bad luck if a transfer fails.
constexpr double light_loss = 0.05;

line_settings any_line(test_rng& draw) {
  line_settings result;
  result.delay_ns = draw.between(0, 150) * ms;
  if (draw.one_in(2))
    result.jitter_ns = draw.between(1, 80) * ms;
  if (!draw.one_in(3))
    result.loss = draw.up_to(draw.one_in(2) ? light_loss : 0.2);
  if (draw.one_in(3))
    result.duplication = draw.up_to(0.2);
  if (draw.one_in(4))
    result.baud = 57'600;
  return result;
}

bool is_mission(const std::vector<mavlink::mission_item_int>& held,
                const std::vector<mavlink::mission_item_int>& plan) {
  return !mavlink::first_difference(plan, held, true);
}

// What OUTCOME says of an upload of PLAN is what the vehicle went through since it held FIRST missions.
void check_truth(transfer_world& world, const transfer::outcome& outcome,
                 const std::vector<mavlink::mission_item_int>& before,
                 const std::vector<mavlink::mission_item_int>& plan, std::size_t first) {
  const auto& history = world.history();
  const bool was_held = std::any_of(history.begin() + static_cast<std::ptrdiff_t>(first), history.end(),
                                    [&](const auto& each) { return is_mission(each.items, plan); });
  const auto& held = world.vehicle().plan(mav_mission_type::mission).items;
  RC_LOG() << io::name_of(outcome.verdict) << ' ' << io::name_of(outcome.proof) << ' ' << io::name_of(outcome.holding)
           << ' ' << outcome.reason << '\n';
  if (outcome.verdict == verdict::accepted)
    RC_ASSERT(was_held);
  RC_ASSERT((outcome.verdict == verdict::accepted) == (outcome.holding == holding::this_plan));
  if (outcome.holding == holding::unchanged)
    RC_ASSERT(transfer_world::is_same(held, before) || !is_mission(held, plan));
  if (outcome.holding == holding::other)
    RC_ASSERT(!is_mission(held, plan));
}

void check_progress(const transfer_world::station& station, int total) {
  int last = 0;
  for (const auto& each : station.progress) {
    RC_ASSERT(each.total == total);
    RC_ASSERT(each.done >= last);
    RC_ASSERT(each.done <= total);
    last = each.done;
  }
}

// True if OUTCOME is a success, which it has to be unless bad luck on a bad line kept both sides from hearing each
// other.
bool has_succeeded(const transfer::outcome& outcome, const line_settings& line) {
  if (outcome.verdict == verdict::accepted)
    return true;
  RC_ASSERT(line.loss > light_loss);
  RC_ASSERT(outcome.verdict == verdict::timed_out || outcome.verdict == verdict::refused);
  return false;
}

rc::Gen<std::uint32_t> any_seed() { return rc::gen::noShrink(rc::gen::arbitrary<std::uint32_t>()); }

RC_GTEST_PROP(transfer_property, an_undisturbed_upload_over_any_line_ends_with_the_plan_on_the_vehicle, ()) {
  const auto seed = *any_seed();
  test_rng draw(seed);
  const auto [vehicle, profile] = any_peer(draw);
  const auto line = any_line(draw);
  transfer_world world(vehicle, profile, line, seed);
  if (draw.one_in(2))
    world.report_mission_every_second();
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto plan = mission_of(draw.between(2, 60), seed + i);
    const auto before = world.vehicle().plan(mav_mission_type::mission).items;
    const auto first = world.history().size();
    world.ours().progress.clear();
    const auto outcome = world.upload(plan);
    check_truth(world, outcome, before, plan, first);
    check_progress(world.ours(), static_cast<int>(plan.size()));
    if (has_succeeded(outcome, line))
      RC_ASSERT(holds(world.vehicle(), plan));
  }
}

RC_GTEST_PROP(transfer_property, an_upload_that_is_cancelled_at_any_moment_says_what_is_known, ()) {
  const auto seed = *any_seed();
  test_rng draw(seed);
  const auto [vehicle, profile] = any_peer(draw);
  const auto line = any_line(draw);
  transfer_world world(vehicle, profile, line, seed);
  const auto old_plan = mission_of(draw.between(2, 20), seed);
  if (!has_succeeded(world.upload(old_plan), line))
    return;
  const auto plan = mission_of(draw.between(2, 40), seed + 1);
  const auto first = world.history().size();
  world.begin(world.ours(), world.ours().client.upload(mav_mission_type::mission, plan, world.time().now_ns()));
  world.run_for(draw.between(0, 1'500) * ms);
  world.begin(world.ours(), world.ours().client.cancel(world.time().now_ns()));
  RC_ASSERT(world.ours().client.is_idle());
  const auto cancelled = world.ours().outcomes.back();
  RC_ASSERT(cancelled.verdict == verdict::cancelled || cancelled.verdict == verdict::accepted);
  if (draw.one_in(2))
    world.let_it_settle();
  check_truth(world, cancelled, old_plan, plan, first);
  if (cancelled.holding == holding::unchanged)
    RC_ASSERT(is_mission(world.vehicle().plan(mav_mission_type::mission).items, old_plan));

  // The next one works, whatever is left of this one.
  const auto next = mission_of(draw.between(2, 40), seed + 2);
  if (has_succeeded(world.upload(next), line))
    RC_ASSERT(holds(world.vehicle(), next));
}

RC_GTEST_PROP(transfer_property, a_client_that_begins_anew_never_mixes_two_plans, ()) {
  const auto seed = *any_seed();
  test_rng draw(seed);
  const auto [vehicle, profile] = any_peer(draw);
  const auto line = any_line(draw);
  transfer_world world(vehicle, profile, line, seed);
  world.begin(world.ours(), world.ours().client.upload(mav_mission_type::mission, mission_of(draw.between(2, 40), seed),
                                                       world.time().now_ns()));
  world.run_for(draw.between(0, 1'000) * ms);
  world.restart_our_client();
  // A process needs longer to start than frames stay on a line.
  world.run_for(1'000 * ms);
  world.ours().outcomes.clear();
  const auto plan = mission_of(draw.between(2, 40), seed + 1);
  if (has_succeeded(world.upload(plan), line))
    RC_ASSERT(holds(world.vehicle(), plan));
}

RC_GTEST_PROP(transfer_property, an_upload_survives_a_vehicle_that_restarts_in_the_middle, ()) {
  const auto seed = *any_seed();
  test_rng draw(seed);
  const auto [vehicle, profile] = any_peer(draw);
  auto line = any_line(draw);
  transfer_world world(vehicle, profile, line, seed);
  const auto plan = mission_of(draw.between(2, 60), seed);
  world.begin(world.ours(), world.ours().client.upload(mav_mission_type::mission, plan, world.time().now_ns()));
  world.run_for(draw.between(0, 1'000) * ms);
  world.reboot_vehicle(draw.between(0, 9'000) * ms);
  RC_ASSERT(world.run_until_idle(world.ours()));
  const auto outcome = world.ours().outcomes.back();
  check_truth(world, outcome, {}, plan, 0);
  RC_ASSERT(outcome.verdict == verdict::accepted || outcome.verdict == verdict::timed_out);
}

RC_GTEST_PROP(transfer_property, a_second_station_disturbs_no_upload_and_no_word_of_it_is_false, ()) {
  const auto seed = *any_seed();
  test_rng draw(seed);
  const auto [vehicle, profile] = any_peer(draw);
  const auto line = any_line(draw);
  transfer_world world(vehicle, profile, line, seed);
  auto& other = world.add_station(other_station_id, line);
  const auto plan = mission_of(draw.between(2, 60), seed);
  const auto theirs = mission_of(draw.between(2, 60), seed + 1);
  const auto begin_ours = [&] {
    world.begin(world.ours(), world.ours().client.upload(mav_mission_type::mission, plan, world.time().now_ns()));
  };
  const bool we_are_first = draw.one_in(2);
  if (we_are_first)
    begin_ours();
  world.run_for(draw.between(0, 1'000) * ms);
  const auto now_ns = world.time().now_ns();
  switch (draw.between(0, 2)) {
  case 0:
    world.begin(other, other.client.upload(mav_mission_type::mission, theirs, now_ns));
    break;
  case 1:
    world.begin(other, other.client.download(mav_mission_type::mission, now_ns));
    break;
  default:
    world.begin(other, other.client.clear(mavlink::mav_mission_type::fence, now_ns));
  }
  if (!we_are_first)
    begin_ours();
  RC_ASSERT(world.run_until_idle(world.ours()));
  RC_ASSERT(world.run_until_idle(other));
  const auto was_held = [&](const auto& mission) {
    return std::any_of(world.history().begin(), world.history().end(),
                       [&](const auto& each) { return is_mission(each.items, mission); });
  };
  if (world.ours().outcomes.back().verdict == verdict::accepted)
    RC_ASSERT(was_held(plan));
  if (world.ours().outcomes.back().holding == holding::unchanged)
    RC_ASSERT(!was_held(plan));
}

RC_GTEST_PROP(transfer_property, what_is_read_over_any_line_is_what_the_vehicle_holds, ()) {
  const auto seed = *any_seed();
  test_rng draw(seed);
  const auto [vehicle, profile] = any_peer(draw);
  const auto line = any_line(draw);
  transfer_world world(vehicle, profile, line, seed);
  if (!has_succeeded(world.upload(mission_of(draw.between(2, 60), seed)), line))
    return;
  const auto read = world.download();
  if (has_succeeded(read, line))
    RC_ASSERT(transfer_world::is_same(read.items, world.vehicle().plan(mav_mission_type::mission).items));
  if (has_succeeded(world.clear(), line))
    RC_ASSERT(world.vehicle().plan(mav_mission_type::mission).items.empty());
}

} // namespace transfer_property_test
} // namespace godwit::tests
