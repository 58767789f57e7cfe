#include "programs/godwit-sim/vehicle/flight/maneuver.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace maneuver_test {

constexpr double step_s = 0.02;

struct sim_maneuver : testing::Test {
  mover multirotor{multirotor_craft(), home};
  mover rover{rover_craft(), home};
  maneuver legs;

  // How many steps it takes, at most a minute's.
  int finish(mover& vehicle) {
    int steps = 0;
    for (; !legs.is_done() && steps < 60 * 50; ++steps)
      legs.step(vehicle, own_pace(vehicle.what()), step_s);
    return steps;
  }
  static double height_m(const mover& of) { return of.where().where.altitude_m - home.altitude_m; }
};

TEST_F(sim_maneuver, without_legs_it_is_done) {
  legs.begin({});
  EXPECT_TRUE(legs.is_done());
  legs.step(rover, own_pace(rover.what()), step_s);
  EXPECT_EQ(rover.where().where, home);
}

TEST_F(sim_maneuver, legs_come_one_after_the_other) {
  auto place = moved(home, {90, 20});
  place.altitude_m += 10;
  legs.begin({climb_leg{home.altitude_m + 10}, go_leg{place, 2, true}, land_leg{}});
  double way_while_low_m = 0;
  while (height_m(multirotor) < 9) {
    legs.step(multirotor, own_pace(multirotor.what()), step_s);
    way_while_low_m = between(home, multirotor.where().where).distance_m;
  }
  EXPECT_LT(way_while_low_m, 0.1);
  finish(multirotor);
  EXPECT_TRUE(legs.is_done());
  EXPECT_FALSE(multirotor.is_in_air());
  EXPECT_LT(between(place, multirotor.where().where).distance_m, 2);
}

TEST_F(sim_maneuver, a_wait_takes_its_time) {
  legs.begin({wait_leg{3}});
  EXPECT_NEAR(finish(rover) * step_s, 3, 0.03);
}

TEST_F(sim_maneuver, a_stay_has_no_end_and_nothing_waits_for_it) {
  legs.begin({stay_leg{}});
  EXPECT_EQ(finish(rover), 60 * 50);
  EXPECT_TRUE(legs.is_settled());
}

TEST_F(sim_maneuver, a_multirotor_settles_at_the_place_and_the_altitude_and_not_only_within_the_radius) {
  auto place = moved(home, {0, 30});
  place.altitude_m += 10;
  legs.begin({climb_leg{place.altitude_m}, go_leg{place, 5, true}});
  finish(multirotor);
  for (int step = 0; step < 10 * 50; ++step)
    legs.step(multirotor, own_pace(multirotor.what()), step_s);
  EXPECT_TRUE(multirotor.is_still());
  EXPECT_LT(between(place, multirotor.where().where).distance_m, 0.1);
  EXPECT_EQ(multirotor.where().where.altitude_m, place.altitude_m);
}

TEST_F(sim_maneuver, a_place_is_reached_within_its_radius) {
  const auto place = moved(home, {0, 30});
  legs.begin({go_leg{place, 7, false}});
  finish(rover);
  EXPECT_NEAR(between(place, rover.where().where).distance_m, 7, 0.05);
}

TEST_F(sim_maneuver, a_speed_of_the_leg_goes_before_the_pace) {
  legs.begin({go_leg{moved(home, {0, 30}), 2, false, 0.5}});
  for (int step = 0; step < 500; ++step)
    legs.step(rover, own_pace(rover.what()), step_s);
  EXPECT_NEAR(rover.where().ground_speed_mps, 0.5, 1e-9);
}

// A radius smaller than a step must not make it turn round for ever.
TEST_F(sim_maneuver, a_radius_of_nothing_is_reached_at_20_m_s) {
  craft fast = rover_craft();
  fast.speed_mps = 20;
  mover racer(fast, home);
  legs.begin({go_leg{moved(home, {0, 600}), 0, false}});
  EXPECT_LT(finish(racer) * step_s, 45);
}

} // namespace maneuver_test
} // namespace godwit::sim::test
