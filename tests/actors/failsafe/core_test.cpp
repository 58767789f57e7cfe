#include <algorithm>
#include <iterator>

#include <gtest/gtest.h>

#include "tests/actors/failsafe/flight_world.hpp"

namespace {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::mission::fence_kind;
using godwit::vehicle_link::command_verdict;

constexpr vehicle_class classes[] = {vehicle_class::multirotor, vehicle_class::fixed_wing, vehicle_class::rover};

std::vector<action> actions_of(const flight_world& world) {
  std::vector<action> result;
  for (const auto& each : world.sent)
    result.push_back(each.what);
  return result;
}

using these = std::vector<action>;

flight_world fenced(vehicle_class what = vehicle_class::multirotor) {
  flight_world world(what);
  world.set_fences({fence_of(fence_kind::inclusion, square(100), {}, 120)});
  world.run_s(10);
  return world;
}

// A steady gauge that fell slowly.
void drain_to(flight_world& world, int percent) {
  while (world.battery_percent > percent) {
    world.battery_percent = std::max(percent, world.battery_percent - 15);
    world.run_s(1);
  }
  world.run_s(7);
}

// -- the operator's link --------------------------------------------------------------------------

TEST(failsafe_core, operator_link_lost_nothing_at_25_s_and_return_at_30_s) {
  for (const auto what : classes) {
    flight_world world(what);
    world.run_s(10);
    const auto last_heard_ms = world.now_ms() - 100;
    world.operator_there = false;
    world.run_s(25);
    EXPECT_TRUE(world.sent.empty());
    EXPECT_TRUE(world.has_warned_of("silent")) << "degraded";
    world.run_s(6);
    EXPECT_EQ(actions_of(world), these{action::return_home});
    EXPECT_NEAR(static_cast<double>(*world.first_sent_ms - last_heard_ms), 30'000, 200);
  }
}

TEST(failsafe_core, the_link_that_comes_back_does_not_cancel_the_return) {
  flight_world world;
  world.run_s(10);
  world.operator_there = false;
  world.run_s(40);
  world.operator_there = true;
  world.run_s(60);
  EXPECT_EQ(actions_of(world), these{action::return_home});
  EXPECT_TRUE(world.lifted.empty());
  EXPECT_EQ(world.mode, in_return);
  EXPECT_TRUE(world.has_warned_of("heard again"));
}

TEST(failsafe_core, an_operators_override_cancels_the_return_and_sends_nothing_by_itself) {
  flight_world world;
  world.run_s(10);
  world.operator_there = false;
  world.run_s(40);
  world.override_for_s(rule::operator_link, 600);
  world.run_s(1);
  ASSERT_EQ(world.answered.size(), 1U);
  EXPECT_TRUE(world.answered[0].taken);
  ASSERT_EQ(world.lifted.size(), 1U);
  EXPECT_EQ(world.lifted[0].why, rule::operator_link);
  world.run_s(120);
  EXPECT_EQ(world.sent.size(), 1U) << "the return from before";
}

TEST(failsafe_core, at_the_deadline_of_an_override_the_rule_acts_when_its_cause_is_still_there) {
  flight_world world;
  world.run_s(10);
  world.override_for_s(rule::operator_link, 120);
  world.operator_there = false;
  world.run_s(119);
  EXPECT_TRUE(world.sent.empty());
  world.run_s(2);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, while_an_object_is_followed_the_link_may_be_lost_30_s_longer) {
  flight_world world;
  world.run_s(10);
  world.tell(following{true});
  world.operator_there = false;
  world.run_s(59);
  EXPECT_TRUE(world.sent.empty());
  world.run_s(2);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, an_operator_who_was_never_seen_is_never_lost_except_when_required) {
  for (const auto policy :
       {operator_link_policy::off, operator_link_policy::once_seen, operator_link_policy::required}) {
    flight_world world(vehicle_class::multirotor, {.operator_link = policy});
    world.operator_there = false;
    world.run_s(60);
    EXPECT_EQ(world.sent.size(), policy == operator_link_policy::required ? 1U : 0U);
  }
}

TEST(failsafe_core, with_operator_link_off_nobody_is_missed) {
  flight_world world(vehicle_class::multirotor, {.operator_link = operator_link_policy::off});
  world.run_s(10);
  world.operator_there = false;
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, a_ground_port_that_is_dead_is_an_operator_who_is_not_heard) {
  flight_world world;
  world.run_s(10);
  world.port_alive = false;
  world.run_s(31);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

// -- the battery ----------------------------------------------------------------------------------

TEST(failsafe_core, at_15_percent_a_multirotor_lands_an_aeroplane_returns_and_a_rover_holds) {
  const these wanted[] = {{action::land}, {action::return_home}, {action::hold}};
  for (std::size_t i = 0; i < std::size(classes); ++i) {
    flight_world world(classes[i]);
    world.override_for_s(rule::battery_low, 3'000);
    world.run_s(1);
    drain_to(world, 15);
    EXPECT_EQ(actions_of(world), wanted[i]);
  }
}

TEST(failsafe_core, at_15_percent_an_aeroplane_takes_the_landing_of_its_mission) {
  flight_world world(vehicle_class::fixed_wing);
  world.set_fences({}, landing_sequence);
  world.override_for_s(rule::battery_low, 3'000);
  drain_to(world, 14);
  EXPECT_EQ(actions_of(world), these{action::do_land_start});
  world.run_s(30);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.pilots_seen, 0);
}

TEST(failsafe_core, an_aeroplane_that_is_at_its_landing_already_is_not_told_to_begin_it_again) {
  flight_world world(vehicle_class::fixed_wing);
  world.set_fences({}, landing_sequence);
  world.override_for_s(rule::battery_low, 3'000);
  world.run_s(1);
  world.sequence = landing_sequence + 2;
  drain_to(world, 14);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_EQ(world.acted.size(), 1U);
}

TEST(failsafe_core, a_sequence_of_the_plan_before_or_of_no_plan_is_no_landing) {
  for (const std::uint16_t sequence : {std::uint16_t{landing_sequence}, std::uint16_t{65535}}) {
    flight_world world(vehicle_class::fixed_wing);
    world.override_for_s(rule::battery_low, 3'000);
    world.sequence = sequence;
    world.run_s(1);
    world.sends_sequence = sequence == 65535;
    world.set_fences({}, landing_sequence);
    drain_to(world, 14);
    EXPECT_EQ(actions_of(world).at(0), action::do_land_start);
  }
}

TEST(failsafe_core, at_25_percent_every_vehicle_returns) {
  for (const auto what : classes) {
    flight_world world(what);
    drain_to(world, 25);
    EXPECT_EQ(actions_of(world), these{action::return_home});
  }
}

TEST(failsafe_core, a_low_battery_can_be_overridden_until_a_deadline_and_a_critical_one_never) {
  flight_world world;
  world.override_for_s(rule::battery_low, 600);
  world.override_for_s(rule::battery_critical, 600);
  world.run_s(1);
  ASSERT_EQ(world.answered.size(), 2U);
  EXPECT_NE(world.answered[0].taken, world.answered[1].taken);
  drain_to(world, 20);
  EXPECT_TRUE(world.sent.empty());
  drain_to(world, 15);
  EXPECT_EQ(actions_of(world), these{action::land});
}

TEST(failsafe_core, a_battery_that_jumps_by_more_than_20_points_is_unknown_and_yellow_and_nothing_is_done) {
  flight_world world;
  world.run_s(10);
  for (int i = 0; i < 30; ++i) {
    world.battery_percent = i % 2 == 0 ? 10 : 60;
    world.run_s(1);
    EXPECT_EQ(world.health().how, wellness::impaired);
  }
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, a_battery_of_which_the_autopilot_knows_nothing_is_yellow_and_nothing_is_done) {
  flight_world world;
  world.battery_percent = -1;
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_EQ(world.health().how, wellness::impaired);
}

// -- the fences -----------------------------------------------------------------------------------

TEST(failsafe_core, a_breach_returns_what_flies_and_stops_a_rover_within_a_tick) {
  const these wanted[] = {{action::return_home}, {action::return_home}, {action::hold}};
  for (std::size_t i = 0; i < std::size(classes); ++i) {
    auto world = fenced(classes[i]);
    EXPECT_TRUE(world.sent.empty());
    world.east_m = 101; // with the position that goes out now
    const auto breached_ms = world.now_ms();
    world.run_s(10);
    EXPECT_EQ(actions_of(world), wanted[i]);
    EXPECT_LE(*world.first_sent_ms - breached_ms, 250);
  }
}

TEST(failsafe_core, above_the_ceiling_is_a_breach) {
  auto world = fenced();
  world.altitude_m = 121;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, a_corner_that_was_cut_between_two_positions_is_a_breach) {
  flight_world world;
  world.set_fences({fence_of(fence_kind::exclusion, square(2, 20, 0))});
  world.run_s(1);
  world.east_m = 40;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, where_it_will_be_in_2_s_is_a_warning_and_no_breach) {
  auto world = fenced();
  world.east_m = 97;
  world.run_s(10);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_TRUE(world.has_warned_of("a fence is near"));
  EXPECT_EQ(std::count_if(world.warnings.begin(), world.warnings.end(),
                          [](const std::string& each) { return each.find("near") != std::string::npos; }),
            1);
}

TEST(failsafe_core, a_position_older_than_1_s_gives_no_verdict_and_is_yellow) {
  auto world = fenced();
  world.sends_positions = false;
  world.east_m = 500;
  world.run_s(5);
  EXPECT_EQ(world.health().how, wellness::impaired);
  EXPECT_NE(world.health().reason.find("position"), std::string::npos);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, coming_back_over_the_fence_does_not_cancel_the_return) {
  auto world = fenced();
  world.east_m = 101;
  world.run_s(2);
  world.east_m = 50;
  world.run_s(20);
  world.east_m = 101;
  world.run_s(20);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.mode, in_return);
}

TEST(failsafe_core, fences_that_are_refused_leave_the_ones_from_before) {
  auto world = fenced();
  world.set_fences({fence_of(fence_kind::inclusion, {{0, 0}, {1, 1}})});
  world.run_s(1);
  ASSERT_EQ(world.limits_answered.size(), 2U);
  EXPECT_FALSE(world.limits_answered[1].taken);
  EXPECT_FALSE(world.limits_answered[1].reason.empty());
  EXPECT_EQ(world.health().how, wellness::bad);
  world.east_m = 101;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

// -- on an edge, once, latched, only in the air ----------------------------------------------------

TEST(failsafe_core, on_the_ground_nothing_acts) {
  for (const auto what : {vehicle_class::multirotor, vehicle_class::fixed_wing}) {
    auto world = fenced(what);
    world.landed = landed_state::on_ground;
    world.run_s(3);
    world.east_m = 500;
    world.operator_there = false;
    drain_to(world, 5);
    world.run_s(60);
    EXPECT_TRUE(world.sent.empty());
  }
}

TEST(failsafe_core, disarmed_nothing_acts) {
  auto world = fenced();
  world.armed = false;
  world.run_s(1);
  world.east_m = 500;
  drain_to(world, 5);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, a_rover_that_stands_is_left_alone) {
  auto world = fenced(vehicle_class::rover);
  world.east_mps = 0;
  world.run_s(1);
  world.east_m = 500;
  world.operator_there = false;
  drain_to(world, 5);
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
  world.east_mps = 1;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::hold});
}

TEST(failsafe_core, what_began_on_the_ground_acts_at_take_off) {
  flight_world world;
  world.landed = landed_state::on_ground;
  world.run_s(5);
  drain_to(world, 10);
  EXPECT_TRUE(world.sent.empty());
  world.landed = landed_state::taking_off;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::land});
}

TEST(failsafe_core, a_cause_that_lasts_acts_once) {
  auto world = fenced();
  world.east_m = 101;
  world.run_s(300);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.acted.size(), 1U);
}

TEST(failsafe_core, a_lower_one_never_cancels_a_higher) {
  auto world = fenced(vehicle_class::rover);
  world.east_m = 101;
  world.run_s(2);
  drain_to(world, 20); // a rover returns for this, and holds for the fence
  world.operator_there = false;
  world.run_s(60);
  EXPECT_EQ(actions_of(world), these{action::hold});
  EXPECT_EQ(world.mode, in_hold);
}

TEST(failsafe_core, a_higher_one_cancels_a_lower) {
  flight_world world;
  drain_to(world, 20);
  EXPECT_EQ(actions_of(world), these{action::return_home});
  drain_to(world, 15);
  EXPECT_EQ(actions_of(world), (these{action::return_home, action::land}));
  EXPECT_EQ(world.pilots_seen, 0);
}

TEST(failsafe_core, a_higher_one_that_wants_the_same_sends_nothing_and_takes_the_lower_ones_place) {
  auto world = fenced();
  drain_to(world, 20);
  world.east_m = 101;
  world.run_s(5);
  EXPECT_EQ(actions_of(world), these{action::return_home});
  ASSERT_EQ(world.acted.size(), 2U);
  EXPECT_EQ(world.acted[1].why, rule::fence);
}

TEST(failsafe_core, of_two_in_one_tick_the_higher_acts) {
  auto world = fenced();
  world.landed = landed_state::on_ground;
  world.run_s(3);
  drain_to(world, 10);
  world.east_m = 101;
  world.landed = landed_state::in_air;
  world.run_s(2);
  EXPECT_EQ(actions_of(world), these{action::land});
}

TEST(failsafe_core, an_override_that_lifts_a_return_gives_what_was_covered_its_say) {
  auto world = fenced(vehicle_class::rover);
  world.east_m = 101;
  world.run_s(2);
  drain_to(world, 20);
  EXPECT_EQ(actions_of(world), these{action::hold});
  world.override_for_s(rule::fence, 600);
  world.run_s(1);
  EXPECT_EQ(world.lifted.size(), 1U);
  EXPECT_EQ(actions_of(world), (these{action::hold, action::return_home}));
}

TEST(failsafe_core, who_returns_or_lands_already_is_not_told_to_return) {
  for (const auto& mode : {in_return, in_landing}) {
    flight_world world;
    world.tell(expect_mode{mode.kind, 0});
    world.run_s(1);
    world.mode = mode;
    world.run_s(1);
    drain_to(world, 20);
    EXPECT_TRUE(world.sent.empty());
    EXPECT_EQ(world.acted.size(), 1U) << "it is latched all the same";
  }
}

TEST(failsafe_core, the_next_flight_begins_with_no_latch) {
  auto world = fenced();
  world.east_m = 101;
  world.run_s(2);
  world.landed = landed_state::on_ground;
  world.run_s(3);
  world.armed = false;
  world.east_m = 0;
  world.mode = in_mission;
  world.run_s(3);
  world.armed = true;
  world.landed = landed_state::in_air;
  world.run_s(3);
  EXPECT_EQ(world.sent.size(), 1U);
  world.east_m = 101;
  world.run_s(2);
  EXPECT_EQ(world.sent.size(), 2U);
}

TEST(failsafe_core, a_vehicle_of_unknown_kind_is_not_commanded_and_health_is_red) {
  flight_world world(vehicle_class::unknown);
  drain_to(world, 10);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_EQ(world.health().how, wellness::bad);
}

// -- who flies ------------------------------------------------------------------------------------

TEST(failsafe_core, it_acts_while_the_mission_is_paused) {
  auto world = fenced();
  world.tell(expect_mode{mode_kind::hold, 5'000});
  world.mode = in_hold;
  world.run_s(10);
  EXPECT_EQ(world.pilots_seen, 0);
  world.east_m = 101;
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, it_acts_while_the_executor_is_dead) {
  flight_world world; // nobody ever said a word but vehicle and ground
  drain_to(world, 10);
  EXPECT_EQ(actions_of(world).back(), action::land);
}

TEST(failsafe_core, after_a_takeover_it_only_warns) {
  auto world = fenced();
  world.mode = in_manual;
  world.run_s(2);
  EXPECT_EQ(world.pilots_seen, 1);
  world.east_m = 500;
  world.operator_there = false;
  drain_to(world, 5);
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_TRUE(
      world.has_warned_of("a fence is breached: it is outside of all inclusion fences; a pilot has the vehicle"));
  EXPECT_TRUE(world.has_warned_of("the battery is at 5 %; a pilot"));
  EXPECT_TRUE(world.has_warned_of("lost; a pilot"));
}

TEST(failsafe_core, a_takeover_that_the_executor_saw_counts_as_well) {
  auto world = fenced();
  world.tell(taken_over{});
  world.east_m = 500;
  world.run_s(20);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, it_never_fights_a_pilot_who_ends_its_own_return) {
  auto world = fenced();
  world.east_m = 101;
  world.run_s(5);
  EXPECT_EQ(world.mode, in_return);
  world.mode = in_manual;
  world.run_s(60);
  EXPECT_EQ(world.sent.size(), 1U);
  EXPECT_EQ(world.mode, in_manual);
}

TEST(failsafe_core, it_stops_trying_when_a_pilot_takes_over) {
  auto world = fenced();
  world.refuses = command_verdict::refused;
  world.east_m = 101;
  world.run_s(5);
  EXPECT_GT(world.sent.size(), 10U);
  world.mode = in_manual;
  world.run_s(1);
  const auto sent = world.sent.size();
  world.run_s(60);
  EXPECT_EQ(world.sent.size(), sent);
}

TEST(failsafe_core, handed_back_it_acts_on_what_still_holds) {
  auto world = fenced();
  world.mode = in_manual;
  world.run_s(2);
  world.east_m = 101;
  world.run_s(20);
  EXPECT_TRUE(world.sent.empty());
  world.tell(hand_back{});
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_core, handed_back_it_leaves_alone_what_is_over) {
  auto world = fenced();
  world.mode = in_manual;
  world.run_s(2);
  world.east_m = 101;
  world.run_s(2);
  world.east_m = 0;
  world.run_s(2);
  world.tell(hand_back{});
  world.tell(expect_mode{mode_kind::mission, 5'000});
  world.run_ms(100);
  world.mode = in_mission;
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
  EXPECT_EQ(world.pilots_seen, 1);
}

TEST(failsafe_core, of_a_takeover_and_a_hand_back_in_one_tick_the_takeover_counts) {
  for (const bool takeover_first : {false, true}) {
    auto world = fenced();
    if (takeover_first)
      world.tell(taken_over{});
    world.tell(hand_back{});
    if (!takeover_first)
      world.tell(taken_over{});
    world.east_m = 101;
    world.run_s(10);
    EXPECT_TRUE(world.sent.empty());
  }
}

TEST(failsafe_core, a_takeover_that_is_told_after_the_landing_is_about_a_flight_that_has_ended) {
  auto world = fenced();
  world.armed = false;
  world.landed = landed_state::on_ground;
  world.run_s(2);
  world.tell(taken_over{});
  world.run_s(2);
  world.armed = true;
  world.landed = landed_state::in_air;
  world.run_s(2);
  world.east_m = 101;
  world.run_s(1);
  EXPECT_EQ(world.sent.size(), 1U);
}

TEST(failsafe_core, where_it_is_set_so_it_acts_in_manual_flight_too) {
  flight_world world(vehicle_class::multirotor, {.failsafe_in_manual = true});
  world.run_s(5);
  world.mode = in_manual;
  world.run_s(5);
  drain_to(world, 20);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

// -- sending --------------------------------------------------------------------------------------

TEST(failsafe_core, sending_fails_again_each_tick_until_it_gets_through) {
  auto world = fenced();
  world.refuses = command_verdict::not_sent;
  world.east_m = 101;
  world.run_ms(2'000);
  EXPECT_EQ(world.sent.size(), 20U);
  EXPECT_EQ(world.health().how, wellness::bad);
  EXPECT_TRUE(world.has_warned_of("does not get through"));
  world.refuses.reset();
  world.run_s(10);
  EXPECT_EQ(world.obeyed.size(), 1U);
  EXPECT_EQ(world.health().how, wellness::impaired);
}

TEST(failsafe_core, while_the_autopilot_is_not_heard_nothing_is_done) {
  auto world = fenced();
  world.sends_heartbeats = false;
  world.run_s(6);
  world.operator_there = false;
  world.east_m = 500;
  drain_to(world, 5);
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, when_the_autopilot_is_heard_again_its_mode_is_looked_at_first) {
  for (const bool autopilot_returned : {false, true}) {
    auto world = fenced();
    world.sends_heartbeats = false;
    world.run_s(6);
    world.east_m = 500;
    world.run_s(2);
    if (autopilot_returned)
      world.mode = in_return;
    world.sends_heartbeats = true;
    world.run_s(5);
    EXPECT_EQ(world.sent.size(), autopilot_returned ? 0U : 1U);
  }
}

TEST(failsafe_core, a_command_goes_out_first_and_does_not_wait_for_the_disk) {
  static_assert(command_vehicle::immediate);
  core alone({}, {}, {});
  alone.take(heartbeat{vehicle_class::multirotor, true, in_mission}, {});
  alone.take(landed{landed_state::in_air}, {});
  alone.take(flight_limits{{fence_of(fence_kind::inclusion, square(100))}, {}}, {});
  alone.take(position_at(101, 0), {});
  const auto wanted = alone.tick({});
  ASSERT_GE(wanted.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<command_vehicle>(wanted.front()));
  ASSERT_TRUE(std::holds_alternative<remember>(wanted.back()));
  const auto& kept = std::get<remember>(wanted.back()).what;
  EXPECT_EQ(kept.now.reacts.value().phase, reaction_phase::in_flight);
  EXPECT_TRUE(kept.limits.has_value());
}

TEST(failsafe_core, while_nothing_happens_nothing_is_written_and_nothing_is_said) {
  auto world = fenced();
  const auto written = world.remembered;
  const auto said = world.warnings.size();
  world.run_s(600);
  EXPECT_EQ(world.remembered, written);
  EXPECT_EQ(world.warnings.size(), said);
}

TEST(failsafe_core, more_overrides_between_two_ticks_than_there_is_room_for_get_no_answer) {
  flight_world world;
  for (std::size_t i = 0; i < max_waiting_overrides + 5; ++i)
    world.override_for_s(rule::fence, 60);
  world.run_s(1);
  EXPECT_EQ(world.answered.size(), max_waiting_overrides);
}

} // namespace
