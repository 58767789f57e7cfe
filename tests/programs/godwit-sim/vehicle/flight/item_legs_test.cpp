#include "programs/godwit-sim/vehicle/flight/item_legs.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace item_legs_test {

// The legs as text, such as "climb 10, go 10 within 2, wait 5"; altitudes above home.
std::string text_of(const leg_list& legs) {
  const auto number = [](double value) { return std::to_string(std::lround(value * 10) / 10.0).substr(0, 4); };
  std::string text;
  for (const auto& each : legs) {
    text += text.empty() ? "" : ", ";
    if (const auto* climb = std::get_if<climb_leg>(&each))
      text += "climb " + number(climb->altitude_m - home.altitude_m);
    else if (const auto* go = std::get_if<go_leg>(&each))
      text += std::string(go->stops ? "stop at " : "pass ") + number(go->to.altitude_m - home.altitude_m) + " within " +
              number(go->radius_m);
    else if (const auto* wait = std::get_if<wait_leg>(&each))
      text += "wait " + number(wait->left_s);
    else
      text += std::holds_alternative<land_leg>(each) ? "land" : "stay";
  }
  return text;
}

// At home, on the ground or AT_M above it.
mover vehicle(const craft& what, double at_m = 0) {
  mover made(what, home);
  while (made.where().where.altitude_m < home.altitude_m + at_m - 0.01)
    made.go({{}, home.altitude_m + at_m, true}, own_pace(what), 0.02);
  return made;
}

mover flying() { return vehicle(multirotor_craft(), 30); }
mover standing() { return vehicle(multirotor_craft()); }
mover driving() { return vehicle(rover_craft()); }

std::string legs(const item& which, const mover& of, bool goes_on = true) {
  const auto found = legs_of(which, {of, home, of.where().where, own_pace(of.what()), goes_on});
  return found ? text_of(*found) : found.error();
}

item with(item which, const std::function<void(item&)>& change) {
  change(which);
  return which;
}

TEST(sim_item_legs, a_waypoint_is_passed_and_left_behind) {
  EXPECT_EQ(legs(waypoint(50, 0, 20), flying()), "pass 20.0 within 2.00");
  EXPECT_EQ(legs(at(nav_spline_waypoint, 50, 0, 20), flying()), "pass 20.0 within 2.00");
}

TEST(sim_item_legs, a_waypoint_with_a_hold_and_the_last_one_are_stops) {
  EXPECT_EQ(legs(waypoint(50, 0, 20, 7), flying()), "stop at 20.0 within 2.00, wait 7.00");
  EXPECT_EQ(legs(waypoint(50, 0, 20), flying(), false), "stop at 20.0 within 2.00");
}

TEST(sim_item_legs, param2_is_the_radius_where_it_is_one) {
  for (const auto& [param2, radius] :
       {std::pair{5.0F, "5.00"}, {0.0F, "2.00"}, {-1.0F, "2.00"}, {std::nanf(""), "2.00"}})
    EXPECT_EQ(legs(with(waypoint(50, 0), [p = param2](item& it) { it.param2 = p; }), flying()),
              std::string("pass 10.0 within ") + radius);
}

TEST(sim_item_legs, a_hold_that_is_no_time_is_none) {
  for (const float hold : {-3.0F, std::nanf(""), HUGE_VALF})
    EXPECT_EQ(legs(waypoint(50, 0, 20, hold), flying()), "pass 20.0 within 2.00") << hold;
}

TEST(sim_item_legs, on_the_ground_a_multirotor_takes_off_to_the_altitude_of_the_waypoint) {
  EXPECT_EQ(legs(waypoint(50, 0, 20), standing()), "climb 20.0, pass 20.0 within 2.00");
  EXPECT_EQ(legs(waypoint(50, 0, 20), driving()), "pass 20.0 within 2.00");
}

TEST(sim_item_legs, an_altitude_at_the_ground_is_no_landing) {
  EXPECT_EQ(legs(waypoint(50, 0, -5), flying()), "pass 1.00 within 2.00");
}

TEST(sim_item_legs, take_off_climbs_first_and_then_goes) {
  EXPECT_EQ(legs(at(nav_takeoff, 50, 0, 12), standing()), "climb 12.0, stop at 12.0 within 2.00");
  EXPECT_EQ(legs(with(command(nav_takeoff), [](item& it) { it.z = 12; }), standing()), "climb 12.0");
}

TEST(sim_item_legs, a_take_off_in_the_air_does_not_come_down) {
  EXPECT_EQ(legs(at(nav_takeoff, 50, 0, 12), flying()), "climb 30.0, stop at 30.0 within 2.00");
  EXPECT_EQ(legs(at(nav_takeoff, 50, 0, 40), flying()), "climb 40.0, stop at 40.0 within 2.00");
}

TEST(sim_item_legs, a_take_off_without_an_altitude_climbs_to_the_crafts_own) {
  EXPECT_EQ(legs(command(nav_takeoff), standing()), "climb 10.0");
  EXPECT_EQ(legs(at(nav_takeoff, 50, 0, 0), standing()), "climb 10.0, stop at 10.0 within 2.00");
  EXPECT_EQ(legs(at(nav_takeoff, 50, 0, std::nanf("")), standing()), "climb 10.0, stop at 10.0 within 2.00");
}

TEST(sim_item_legs, a_rover_does_not_take_off_and_lands_by_stopping) {
  EXPECT_EQ(legs(at(nav_takeoff, 50, 0, 12), driving()), "a rover does not take off");
  EXPECT_EQ(legs(at(nav_land, 50, 0, 0), driving()), "stop at 0.00 within 0.50, land");
}

TEST(sim_item_legs, a_landing_goes_there_as_high_as_it_is_and_down) {
  EXPECT_EQ(legs(at(nav_land, 50, 0, 0), flying()), "stop at 30.0 within 0.50, land");
  EXPECT_EQ(legs(with(command(nav_land), [](item& it) { it.frame = 3; }), flying()), "land");
}

TEST(sim_item_legs, a_landing_elsewhere_begins_with_a_take_off_and_one_here_is_done) {
  EXPECT_EQ(legs(at(nav_land, 50, 0, 0), standing()), "climb 10.0, stop at 10.0 within 0.50, land");
  EXPECT_EQ(legs(at(nav_land, 1, 0, 0), standing()), "land");
}

TEST(sim_item_legs, a_return_climbs_comes_home_and_lands) {
  EXPECT_EQ(legs(command(nav_return_to_launch), flying()), "climb 30.0, stop at 30.0 within 0.50, land");
  EXPECT_EQ(legs(command(nav_return_to_launch), vehicle(multirotor_craft(), 5)),
            "climb 15.0, stop at 15.0 within 0.50, land");
  EXPECT_EQ(legs(command(nav_return_to_launch), standing()), "");
  EXPECT_EQ(legs(command(nav_return_to_launch), driving()), "stop at 0.00 within 2.00");
}

TEST(sim_item_legs, loiters_stay_wait_or_take_the_time_of_their_turns) {
  EXPECT_EQ(legs(at(nav_loiter_unlim, 50, 0, 20), flying()), "stop at 20.0 within 2.00, stay");
  EXPECT_EQ(legs(with(at(nav_loiter_time, 50, 0, 20), [](item& it) { it.param1 = 9; }), flying()),
            "stop at 20.0 within 2.00, wait 9.00");
  const auto turns = with(at(nav_loiter_turns, 50, 0, 20), [](item& it) {
    it.param1 = 2;
    it.param3 = -10; // the other way round
  });
  const auto found = legs_of(turns, {flying(), home, home, own_pace(multirotor_craft()), true});
  EXPECT_NEAR(std::get<wait_leg>(found->back()).left_s, 2 * 2 * std::numbers::pi * 10 / 5, 1e-9);
}

TEST(sim_item_legs, a_delay_waits_where_it_is_and_knows_no_time_of_day) {
  EXPECT_EQ(legs(command(nav_delay, 4), standing()), "wait 4.00");
  EXPECT_EQ(legs(command(nav_delay, -1), standing()), "a delay until a time of day is not known");
}

TEST(sim_item_legs, a_loiter_to_an_altitude_goes_there_first_and_climbs_then) {
  EXPECT_EQ(legs(at(nav_loiter_to_alt, 50, 0, 60), flying()), "stop at 30.0 within 2.00, climb 60.0");
  EXPECT_EQ(legs(at(nav_loiter_to_alt, 50, 0, 60), driving()), "a rover does not climb");
}

TEST(sim_item_legs, a_vertical_take_off_and_landing_are_a_take_off_and_a_landing_to_who_hovers) {
  EXPECT_EQ(legs(at(nav_vtol_takeoff, 0, 0, 20), standing()), legs(at(nav_takeoff, 0, 0, 20), standing()));
  EXPECT_EQ(legs(at(nav_vtol_land, 50, 0, 0), flying()), legs(at(nav_land, 50, 0, 0), flying()));
}

TEST(sim_item_legs, who_hovers_passes_over_a_climb_along_its_course) {
  EXPECT_EQ(legs(at(nav_continue_and_change_alt, 0, 0, 60), flying()), "only a fixed wing keeps its course and climbs");
}

TEST(sim_item_legs, what_is_not_known_is_skipped_with_a_reason) {
  EXPECT_EQ(legs(at(23, 50, 0), flying()), "command 23 is not known");
  EXPECT_EQ(legs(with(waypoint(50, 0), [](item& it) { it.frame = 1; }), flying()), "frame 1 is not known");
}

} // namespace item_legs_test
} // namespace godwit::sim::test
