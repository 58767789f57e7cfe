#include "programs/godwit-sim/vehicle/flight/mover.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace mover_test {

constexpr double step_s = 0.02;
const pace own = own_pace(multirotor_craft());

mover at_height(double height_m) {
  mover made(multirotor_craft(), home);
  for (int step = 0; step < 50 * 60; ++step)
    made.go({{}, home.altitude_m + height_m, true}, own, step_s);
  EXPECT_NEAR(made.where().where.altitude_m, home.altitude_m + height_m, 0.01);
  return made;
}

TEST(sim_mover, a_multirotor_is_in_the_air_when_it_has_left_the_ground) {
  mover it(multirotor_craft(), home);
  EXPECT_FALSE(it.is_in_air());
  EXPECT_TRUE(at_height(2).is_in_air());
}

TEST(sim_mover, at_rest_in_the_air_it_falls_and_lies_still) {
  auto it = at_height(10);
  int steps = 0;
  for (; it.is_in_air(); ++steps)
    it.rest(step_s);
  EXPECT_NEAR(steps * step_s, 1.43, 0.03); // the square root of 2 h / g
  EXPECT_TRUE(it.is_still());
  EXPECT_EQ(it.where().where.altitude_m, home.altitude_m);
}

TEST(sim_mover, a_landing_is_slow_at_the_end_and_stops_on_the_ground) {
  auto it = at_height(12);
  double last_mps = 0;
  for (int step = 0; it.is_in_air() && step < 50 * 60; ++step) {
    last_mps = it.where().climb_mps;
    it.land(own, step_s);
  }
  EXPECT_NEAR(last_mps, -0.5, 0.01);
  EXPECT_FALSE(it.is_in_air());
  EXPECT_TRUE(it.is_still());
  EXPECT_EQ(it.where().where.altitude_m, home.altitude_m);
}

TEST(sim_mover, a_hold_on_the_ground_stays_there) {
  mover it(multirotor_craft(), home);
  it.hold(step_s);
  it.land(own, step_s);
  EXPECT_EQ(it.where().where, home);
  EXPECT_FALSE(it.is_in_air());
}

TEST(sim_mover, dropped_it_lies_on_the_ground_where_it_was) {
  auto it = at_height(20);
  it.drop();
  EXPECT_FALSE(it.is_in_air());
  EXPECT_TRUE(it.is_still());
  EXPECT_EQ(it.where().where.altitude_m, home.altitude_m);
}

TEST(sim_mover, a_rover_is_never_in_the_air) {
  mover it(rover_craft(), home);
  for (int step = 0; step < 500; ++step)
    it.go({{0, 20}, home.altitude_m + 10, false}, own_pace(rover_craft()), step_s);
  EXPECT_FALSE(it.is_in_air());
  EXPECT_EQ(it.where().where.altitude_m, home.altitude_m);
}

} // namespace mover_test
} // namespace godwit::sim::test
