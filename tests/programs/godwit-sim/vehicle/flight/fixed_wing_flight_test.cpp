// A fixed wing on its tasks and missions.
#include <cmath>

#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/flight/flight.hpp"
#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace fixed_wing_flight_test {

trip wing() { return trip(fixed_wing_craft()); }

double from(const trip& it, const position& there) { return between(it.vehicle.where().where, there).distance_m; }

// Another second by second, the distances from THERE: nearest and farthest.
std::pair<double, double> distances(trip& it, const position& there, double seconds) {
  std::pair<double, double> result{1e9, 0};
  for (int i = 0; i < seconds; ++i) {
    it.run(1);
    result = {std::min(result.first, from(it, there)), std::max(result.second, from(it, there))};
  }
  return result;
}

TEST(sim_fixed_wing_flight, it_takes_off_ahead_flies_its_waypoints_and_never_stands_in_the_air) {
  auto it = wing();
  it.follow({at(nav_takeoff, 0, 0, 40), waypoint(400, 0, 40), waypoint(400, 400, 40)});
  ASSERT_TRUE(it.run_until_said("reached 0"));
  EXPECT_NEAR(it.vehicle.altitude_above_home_m(), 40, 2.5);
  EXPECT_NEAR(it.vehicle.where().where.longitude_deg, home.longitude_deg, 1e-6) << "straight on";
  const bool is_done = it.run_until([&] {
    EXPECT_GE(it.vehicle.where().ground_speed_mps, 10);
    return !it.said.empty() && it.said.back() == "completed";
  });
  ASSERT_TRUE(is_done);
  EXPECT_GT(it.time_of("reached 2"), it.time_of("reached 1"));
}

TEST(sim_fixed_wing_flight, a_waypoint_that_it_has_passed_counts_although_it_came_no_nearer_than_its_radius) {
  auto it = wing();
  auto tight = waypoint(300, 0, 40);
  tight.param2 = 1;
  auto beside = waypoint(330, 40, 40); // inside its turning circle
  beside.param2 = 1;
  it.follow({at(nav_takeoff, 0, 0, 40), tight, beside, waypoint(900, 0, 40)});
  EXPECT_TRUE(it.run_until_said("reached 3", 120));
}

TEST(sim_fixed_wing_flight, it_holds_on_circles_around_where_it_began_to) {
  auto it = wing();
  it.follow({at(nav_takeoff, 0, 0, 40), waypoint(500, 0, 40)});
  ASSERT_TRUE(it.run_until_said("begun 1"));
  it.run(5);
  const auto there = it.vehicle.where().where;
  it.vehicle.set_task(task::hold{});
  it.run(40);
  const auto [nearest_m, farthest_m] = distances(it, there, 60);
  EXPECT_NEAR(nearest_m, 60, 5);
  EXPECT_NEAR(farthest_m, 60, 5);
  EXPECT_NEAR(it.vehicle.altitude_above_home_m(), 40, 3);
}

TEST(sim_fixed_wing_flight, it_circles_for_a_loiters_time_on_its_own_radius_and_goes_on) {
  auto it = wing();
  auto circles = at(nav_loiter_time, 400, 0, 40);
  circles.param1 = 60;
  circles.param3 = 200; // ArduPlane keeps its own
  it.follow({at(nav_takeoff, 0, 0, 40), circles, waypoint(0, 0, 40)});
  ASSERT_TRUE(it.run_until_said("begun 1"));
  const auto centre = moved(home, {0, 400});
  ASSERT_TRUE(it.run_until([&] { return from(it, centre) < 100; }));
  it.run(20);
  const auto [nearest_m, farthest_m] = distances(it, centre, 25);
  EXPECT_NEAR(nearest_m, 60, 10);
  EXPECT_NEAR(farthest_m, 60, 10);
  EXPECT_TRUE(it.run_until_said("reached 2"));
}

TEST(sim_fixed_wing_flight, it_lands_at_the_place_on_a_straight_path_and_stays_on_its_item) {
  auto it = wing();
  it.follow({at(nav_takeoff, 0, 0, 40), waypoint(600, 0, 40), at(nav_land, 0, 0, 0)});
  ASSERT_TRUE(it.run_until_said("landed"));
  EXPECT_LT(it.from_home_m(), 100);
  it.run(30);
  EXPECT_EQ(it.vehicle.where().ground_speed_mps, 0);
  EXPECT_LT(it.from_home_m(), 120);
  EXPECT_EQ(it.said.back(), "landed") << "a landing item never ends";
}

TEST(sim_fixed_wing_flight, it_comes_back_to_circles_over_home_for_ever) {
  auto it = wing();
  it.follow({at(nav_takeoff, 0, 0, 40), waypoint(900, 0, 40)});
  ASSERT_TRUE(it.run_until_said("reached 1"));
  it.vehicle.set_task(task::come_back{});
  it.run(120);
  const auto [nearest_m, farthest_m] = distances(it, home, 300);
  EXPECT_NEAR(nearest_m, 60, 5);
  EXPECT_NEAR(farthest_m, 60, 5);
  EXPECT_NEAR(it.vehicle.altitude_above_home_m(), 60, 2);
}

TEST(sim_fixed_wing_flight, on_the_ground_it_goes_nowhere_without_a_take_off) {
  auto it = wing();
  it.follow({waypoint(300, 0, 40), at(nav_land, 0, 0, 0)});
  it.run(60);
  EXPECT_FALSE(it.vehicle.is_in_air());
  EXPECT_LT(it.from_home_m(), 0.1);
  it.vehicle.set_task(task::go{moved(home, {0, 300})});
  it.run(60);
  EXPECT_LT(it.from_home_m(), 0.1);
}

TEST(sim_fixed_wing_flight, without_motors_it_glides_to_the_ground_and_rests) {
  auto it = wing();
  it.follow({at(nav_takeoff, 0, 0, 40), waypoint(900, 0, 40)});
  ASSERT_TRUE(it.run_until_said("begun 1"));
  it.vehicle.set_task(task::rest{});
  EXPECT_TRUE(it.run_until_said("landed", 60));
  it.run(20);
  EXPECT_EQ(it.vehicle.next_step_ns(), flight::never_ns) << "at rest";
}

TEST(sim_fixed_wing_flight, no_mission_makes_it_slower_than_it_can_fly) {
  auto it = wing();
  it.follow({command(do_change_speed, 0, 3), at(nav_takeoff, 0, 0, 40), waypoint(900, 0, 40)});
  ASSERT_TRUE(it.run_until_said("begun 2"));
  it.run(20);
  EXPECT_NEAR(it.vehicle.where().ground_speed_mps, 10, 0.1);
}

} // namespace fixed_wing_flight_test
} // namespace godwit::sim::test
