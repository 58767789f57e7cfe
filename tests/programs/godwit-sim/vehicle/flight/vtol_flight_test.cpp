// A VTOL on its missions: on its rotors and on its wings.
#include <algorithm>

#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/flight/flight.hpp"
#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace vtol_flight_test {

constexpr int to_wings = 1;
constexpr int to_rotors = 2;
constexpr int on_rotors = 3;
constexpr int on_wings = 4;

trip vtol(bool is_px4 = true) {
  auto craft = vtol_craft();
  craft.takes_off_to_place = craft.lands_on_return = is_px4;
  return trip(craft);
}

item transition(int to) { return command(do_vtol_transition, static_cast<float>(to)); }

// What it was, one after the other, until it has said WHAT.
std::vector<int> states_until(trip& it, const std::string& what, double within_s = 400) {
  std::vector<int> states{it.vehicle.vtol_state()};
  const bool is_said = it.run_until(
      [&] {
        if (it.vehicle.vtol_state() != states.back())
          states.push_back(it.vehicle.vtol_state());
        return std::ranges::find(it.said, what) != it.said.end();
      },
      within_s);
  EXPECT_TRUE(is_said) << what;
  return states;
}

TEST(sim_vtol_flight, it_climbs_on_its_rotors_where_it_stands_and_flies_on_its_wings) {
  for (const bool is_px4 : {true, false}) {
    auto it = vtol(is_px4);
    it.follow({at(nav_vtol_takeoff, 100, 0, 30), waypoint(400, 0, 40), waypoint(400, 400, 40)});
    ASSERT_TRUE(it.run_until([&] { return it.vehicle.altitude_above_home_m() > 28; }));
    EXPECT_LT(it.from_home_m(), 1);
    EXPECT_EQ(it.vehicle.vtol_state(), on_rotors);
    EXPECT_EQ(states_until(it, "reached 1"), (std::vector{on_rotors, to_wings, on_wings}));
    EXPECT_GT(it.vehicle.where().ground_speed_mps, 10);
  }
}

TEST(sim_vtol_flight, a_transition_of_its_mission_makes_it_hover_and_fly_on_again) {
  auto it = vtol();
  it.follow({at(nav_vtol_takeoff, 0, 0, 30), waypoint(400, 0, 40), transition(on_rotors), waypoint(400, 200, 40),
             transition(on_wings), waypoint(0, 400, 40), waypoint(0, 800, 40)});
  ASSERT_TRUE(it.run_until_said("reached 1"));
  EXPECT_EQ(states_until(it, "reached 3"), (std::vector{on_wings, to_rotors, on_rotors}));
  EXPECT_LT(it.vehicle.where().ground_speed_mps, 5.1);
  EXPECT_EQ(states_until(it, "reached 5"), (std::vector{on_rotors, to_wings, on_wings}));
}

TEST(sim_vtol_flight, it_changes_before_the_place_of_its_landing_and_comes_down_there) {
  auto it = vtol();
  it.follow({at(nav_vtol_takeoff, 0, 0, 30), waypoint(600, 0, 40), at(nav_vtol_land, 200, 0, 0)});
  ASSERT_TRUE(it.run_until_said("reached 1"));
  EXPECT_EQ(states_until(it, "landed"), (std::vector{on_wings, to_rotors, on_rotors}));
  EXPECT_NEAR(it.from_home_m(), 200, 2);
  EXPECT_EQ(it.vehicle.altitude_above_home_m(), 0);
}

TEST(sim_vtol_flight, its_return_ends_on_its_rotors_at_home_or_in_circles_over_it) {
  for (const bool is_px4 : {true, false}) {
    auto it = vtol(is_px4);
    it.follow({at(nav_vtol_takeoff, 0, 0, 30), waypoint(600, 0, 40), waypoint(1'200, 0, 40)});
    ASSERT_TRUE(it.run_until_said("reached 1"));
    it.vehicle.set_task(task::come_back{});
    it.run(300);
    EXPECT_EQ(it.vehicle.is_in_air(), !is_px4);
    EXPECT_NEAR(it.from_home_m(), is_px4 ? 0 : 60, is_px4 ? 2 : 6);
  }
}

TEST(sim_vtol_flight, a_plane_passes_a_transition_over) {
  trip it(fixed_wing_craft());
  it.follow({at(nav_takeoff, 0, 0, 40), waypoint(400, 0, 40), transition(on_rotors), waypoint(400, 400, 40)});
  ASSERT_TRUE(it.run_until_said("reached 3"));
  EXPECT_GE(it.vehicle.where().ground_speed_mps, 10);
  EXPECT_EQ(it.vehicle.vtol_state(), 0);
}

} // namespace vtol_flight_test
} // namespace godwit::sim::test
