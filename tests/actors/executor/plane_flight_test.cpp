// Whole flights of a fixed wing: it circles where others hold, and comes down by a landing of its plan alone.
#include <algorithm>

#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/world/position.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace plane_flight_test {

using mission::progress_kind;
using operators::command_kind;
using tests::flight_world;
using tests::fly_to;
using tests::is_told;

constexpr auto plane = sim::personality::plane;
constexpr double circle_m = 60;
constexpr double on_circle_m = 8;

mission::document plane_mission() { return tests::short_mission(plane); }

sim::position home() { return sim::vehicle_settings{}.home; }

// For a minute of its time.
testing::AssertionResult circles_around(flight_world& world, const sim::position& there) {
  for (int i = 0; i < 12; ++i) {
    world.run_for(1);
    const auto seen = world.vehicle().describe();
    const double away_m = between(seen.where, there).distance_m;
    if (!seen.in_air || std::abs(away_m - circle_m) > on_circle_m)
      return testing::AssertionFailure() << away_m << " m away\n" << world.story();
  }
  return testing::AssertionSuccess();
}

mission::item survey_of_16_hectares() {
  mission::survey result{"field", {}, 40, 80, 0};
  for (const auto& [north, east] : {std::pair(60, 60), std::pair(60, 140), std::pair(140, 140), std::pair(140, 60)}) {
    const auto at = std::get<mission::waypoint>(tests::place(plane, "", north, east)).at;
    result.polygon.push_back({at.latitude, at.longitude});
  }
  return result;
}

TEST(plane_flight, a_survey_is_flown_to_its_end_and_the_plane_lands) {
  flight_world world({.who = plane, .marks_landings = true});
  auto mission = plane_mission();
  mission.items.insert(mission.items.begin() + 3, survey_of_16_hectares());
  world.load(mission);
  ASSERT_TRUE(world.run_until_phase(phase::done, 900)) << world.story();
  EXPECT_TRUE(is_told(world, progress_kind::reached, "field")) << world.story();
  EXPECT_TRUE(is_told(world, progress_kind::reached, "home")) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
  const auto items = world.durable().flown->items;
  EXPECT_TRUE(std::ranges::any_of(items, [](const auto& each) { return each.command == 189; })) << "DO_LAND_START";
  EXPECT_FALSE(world.vehicle().describe().armed) << world.story();
  EXPECT_LT(between(world.vehicle().describe().where, home()).distance_m, 150);
}

TEST(plane_flight, a_pause_circles_and_resume_goes_on) {
  flight_world world({.who = plane});
  ASSERT_TRUE(fly_to(world, plane_mission(), progress_kind::reached, "w1"));
  ASSERT_TRUE(world.say(command_kind::pause).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 10)) << world.story();
  EXPECT_EQ(world.vehicle().describe().mode, "LOITER");
  world.run_for(10);
  const auto seen = world.vehicle().describe().where;
  world.run_for(5);
  EXPECT_GE(world.vehicle().describe().ground_speed_mps, 10) << "it does not stand";
  EXPECT_LT(between(world.vehicle().describe().where, seen).distance_m, 2 * circle_m + on_circle_m);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

TEST(plane_flight, called_home_it_circles_there_until_somebody_lands_it) {
  flight_world world({.who = plane});
  ASSERT_TRUE(fly_to(world, plane_mission(), progress_kind::reached, "w1"));
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::landing, 20)) << world.story();
  world.run_for(20);
  EXPECT_TRUE(circles_around(world, home()));
  EXPECT_EQ(world.vehicle().describe().mode, "RTL");
  EXPECT_TRUE(world.durable().status.in_flight) << world.story();
}

// A real one with RTL_AUTOLAND 2, called home, was in AUTO 10 ms after RTL: that was called a pilot's.
TEST(plane_flight, called_home_it_lands_by_the_landing_of_its_plan_and_that_is_nobodys_takeover) {
  flight_world world({.who = plane, .marks_landings = true, .rtl_autoland = 2});
  ASSERT_TRUE(fly_to(world, plane_mission(), progress_kind::reached, "w1"));
  const auto orders = world.orders();
  ASSERT_TRUE(world.say(command_kind::come_home).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::landing, 20)) << world.story();
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().mode == "AUTO"; }, 5)) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::aborted, 900)) << world.story();
  EXPECT_FALSE(needs_hand_back(world.durable().status.cause)) << world.story();
  EXPECT_EQ(world.orders(), orders + 1) << "it is called home once\n" << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed);
  EXPECT_FALSE(is_told(world, progress_kind::reached, "home")) << world.story();
}

TEST(plane_flight, a_person_who_calls_it_home_to_the_landing_of_its_plan_has_it_until_it_stands) {
  constexpr std::uint32_t rtl = 11;
  flight_world world({.who = plane, .marks_landings = true, .rtl_autoland = 2});
  ASSERT_TRUE(fly_to(world, plane_mission(), progress_kind::reached, "w1"));
  world.switch_mode(rtl);
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 6))
      << world.story();
  const auto orders = world.orders();
  ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().armed; }, 300)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
}

TEST(plane_flight, after_a_last_waypoint_it_comes_home_by_itself_and_that_is_nobodys_takeover) {
  flight_world world({.who = plane});
  auto mission = plane_mission();
  mission.items.pop_back();
  ASSERT_TRUE(fly_to(world, mission, progress_kind::reached, "w3"));
  const auto orders = world.orders();
  world.run_for(20);
  EXPECT_EQ(world.vehicle().describe().mode, "RTL");
  EXPECT_TRUE(circles_around(world, home()));
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_FALSE(needs_hand_back(world.durable().status.cause)) << world.story();
  EXPECT_EQ(world.reports().back().kind, progress_kind::complete) << world.story();
}

TEST(plane_flight, a_return_shows_rtl_as_it_starts_and_is_not_complete_in_the_air) {
  flight_world world({.who = plane});
  auto mission = plane_mission();
  mission.items.back() = mission::return_home{"home"};
  ASSERT_TRUE(fly_to(world, mission, progress_kind::reached, "w3"));
  const auto orders = world.orders();
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().mode == "RTL"; }, 10)) << world.story();
  world.run_for(20);
  EXPECT_TRUE(circles_around(world, home()));
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_FALSE(needs_hand_back(world.durable().status.cause)) << world.story();
  EXPECT_FALSE(is_told(world, progress_kind::reached, "home")) << world.story();
}

TEST(plane_flight, a_person_who_takes_rtl_in_the_middle_of_its_mission_has_it) {
  constexpr std::uint32_t rtl = 11;
  flight_world world({.who = plane});
  ASSERT_TRUE(fly_to(world, plane_mission(), progress_kind::reached, "w1"));
  world.switch_mode(rtl);
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.cause == pause_cause::taken_over; }, 6))
      << world.story();
}

TEST(plane_flight, a_low_battery_brings_it_to_circles_over_home) {
  flight_world world({.who = plane});
  ASSERT_TRUE(fly_to(world, plane_mission(), progress_kind::reached, "w1"));
  world.vehicle().set_battery(20, world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return world.vehicle().describe().mode == "RTL"; }, 20)) << world.story();
  const auto orders = world.orders();
  world.run_for(20);
  EXPECT_TRUE(circles_around(world, home()));
  EXPECT_EQ(world.reactions().size(), 1U) << "it is obeyed\n" << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::failsafe) << world.story();
}

TEST(plane_flight, a_critical_battery_lands_it_by_the_landing_of_its_plan) {
  flight_world world({.who = plane, .speed = 1, .marks_landings = true});
  ASSERT_TRUE(fly_to(world, plane_mission(), progress_kind::reached, "w1"));
  world.vehicle().set_battery(5, world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return !world.reactions().empty(); }, 20)) << world.story();
  EXPECT_EQ(world.reactions().front().what, failsafe::action::do_land_start) << world.story();
  ASSERT_TRUE(world.run_until([&] { return !world.vehicle().describe().in_air; }, 120)) << world.story();
  EXPECT_EQ(world.vehicle().describe().mode, "AUTO");
  EXPECT_LT(between(world.vehicle().describe().where, home()).distance_m, 150) << world.story();
}

// RTL_AUTOLAND 0 is the default of a real one.
TEST(plane_flight, whose_plan_marks_its_landing_and_that_is_not_armed_so_names_the_parameter_and_flies_nothing) {
  flight_world world({.who = plane, .speed = 1, .marks_landings = true, .rtl_autoland = 0});
  world.load(plane_mission());
  const auto names_it = [&] { return world.sentence().find("Set RTL_AUTOLAND to 3") != std::string::npos; };
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::ready && names_it(); }, 60))
      << world.sentence() << world.story();
  const auto arms = world.arms();
  for (int i = 0; i < 90; ++i) {
    world.run_for(1);
    EXPECT_TRUE(names_it()) << world.sentence();
  }
  EXPECT_EQ(world.arms(), arms) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed);
}

TEST(plane_flight, stood_in_auto_after_its_landing_it_is_put_into_a_mode_in_which_arming_begins_nothing) {
  flight_world world({.who = plane});
  world.load(plane_mission());
  ASSERT_TRUE(world.run_until_phase(phase::done, 900)) << world.story();
  world.run_for(6);
  EXPECT_EQ(world.vehicle().describe().mode, "FBWA") << world.story();
  world.arm_by_hand();
  world.run_for(10);
  EXPECT_FALSE(world.vehicle().describe().in_air) << world.story();
}

// -- what is left of a mission, and needs a take-off that is flown already ------------------------------

// Somebody has brought it down after w1, and has handed it back.
testing::AssertionResult break_off(flight_world& world) {
  if (const auto came = fly_to(world, plane_mission(), progress_kind::reached, "w1"); !came)
    return came;
  world.disarm_by_hand();
  const auto is_down = [&] { return !world.durable().status.in_flight && !world.vehicle().describe().in_air; };
  const bool came_down = world.run_until(is_down, 60) && world.durable().status.cause == pause_cause::taken_over;
  const bool is_back = came_down && world.say(command_kind::hand_back).is_taken;
  world.run_for(1);
  return is_back ? testing::AssertionSuccess() : testing::AssertionFailure() << world.story();
}

bool waits_with_the_rest(const flight_world& world) {
  const auto& at = world.durable().status;
  return at.now == phase::paused && at.cause == pause_cause::not_done && !at.in_flight &&
         at.reason.find("can not be flown from here") != std::string::npos;
}

TEST(plane_rest, that_can_not_be_flown_from_the_ground_waits_for_a_person_and_nothing_is_sent) {
  flight_world world({.who = plane});
  ASSERT_TRUE(break_off(world));
  const auto orders = world.orders();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until([&] { return waits_with_the_rest(world); }, 10)) << world.story();
  EXPECT_NE(world.durable().status.reason.find("'w2'"), std::string::npos) << world.durable().status.reason;
  world.run_for(120);
  EXPECT_TRUE(waits_with_the_rest(world)) << world.story();
  EXPECT_FALSE(world.say(command_kind::start).is_taken);
  ASSERT_TRUE(world.say(command_kind::resume).is_taken) << "who has moved the vehicle may have it looked at again";
  world.run_for(10);
  EXPECT_TRUE(waits_with_the_rest(world)) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_FALSE(world.vehicle().describe().armed);
}

TEST(plane_rest, waits_on_after_a_crash) {
  flight_world world({.who = plane});
  ASSERT_TRUE(break_off(world));
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until([&] { return waits_with_the_rest(world); }, 10)) << world.story();
  const auto orders = world.orders();
  world.crash_all();
  world.run_for(30);
  EXPECT_TRUE(waits_with_the_rest(world)) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
}

TEST(plane_rest, with_a_new_revision_is_prepared_on_a_persons_word_and_started_on_another) {
  flight_world world({.who = plane});
  ASSERT_TRUE(break_off(world));
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until([&] { return waits_with_the_rest(world); }, 10)) << world.story();
  auto again = plane_mission();
  again.revision = 2;
  again.items.insert(again.items.begin() + 2, mission::takeoff{"up again", 20});
  world.load(again);
  world.run_for(30);
  EXPECT_TRUE(waits_with_the_rest(world)) << "whoever stands beside it has not said anything\n" << world.story();
  ASSERT_TRUE(world.say(command_kind::resume).is_taken);
  ASSERT_TRUE(world.run_until_phase(phase::ready, 30)) << world.story();
  world.run_for(30);
  EXPECT_EQ(world.durable().status.now, phase::ready) << world.story();
  ASSERT_TRUE(world.say(command_kind::start).is_taken) << world.story();
  EXPECT_TRUE(world.run_until_phase(phase::done, 900)) << world.story();
}

TEST(plane_rest, is_not_spoken_of_where_nothing_was_flown) {
  flight_world world({.who = plane});
  auto mission = plane_mission();
  mission.items.erase(mission.items.begin());
  world.load(mission);
  world.run_for(60);
  EXPECT_EQ(world.durable().status.now, phase::preflight) << "it is as it always was\n" << world.story();
}

} // namespace plane_flight_test
} // namespace godwit::executor
