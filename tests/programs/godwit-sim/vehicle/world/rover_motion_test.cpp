#include "programs/godwit-sim/vehicle/world/rover_motion.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim::test {
namespace rover_motion_test {

constexpr double rover_step_s = 0.02;
constexpr rover_limits rover_limits;
constexpr position rover_start{47, 8, 400};

// One step towards PLACE at 2 m/s.
void drive_to(body& rover, const position& place, bool stops) {
  drive(rover, rover_limits, {course_nearby(rover.where, place), 2, stops}, rover_step_s);
}

TEST(sim_rover_motion, it_speeds_up_turns_and_brakes_within_its_limits) {
  body rover{.where = rover_start, .heading_deg = 90};
  const auto place = moved(rover_start, {300, 50});
  body before = rover;
  for (int step = 0; step < 3'000; ++step) {
    drive_to(rover, place, true);
    EXPECT_LE(rover.ground_speed_mps, 2);
    EXPECT_LE(std::abs(rover.ground_speed_mps - before.ground_speed_mps),
              rover_limits.acceleration_mps2 * rover_step_s + 1e-12);
    EXPECT_LE(std::abs(turn_of(rover.heading_deg - before.heading_deg)),
              rover_limits.turn_rate_deg_s * rover_step_s + 1e-9);
    EXPECT_EQ(rover.track_deg, rover.heading_deg);
    EXPECT_EQ(rover.where.altitude_m, rover_start.altitude_m);
    before = rover;
  }
  EXPECT_LT(between(rover.where, place).distance_m, 0.2);
}

TEST(sim_rover_motion, who_stops_comes_to_a_stand_and_not_behind_the_place) {
  body rover{.where = rover_start};
  const auto place = moved(rover_start, {0, 30});
  double farthest_deg = 0;
  for (int step = 0; step < 2'000; ++step) {
    drive_to(rover, place, true);
    farthest_deg = std::max(farthest_deg, rover.where.latitude_deg);
  }
  EXPECT_LE(farthest_deg, place.latitude_deg);
  EXPECT_LT(rover.ground_speed_mps, 0.05);
}

TEST(sim_rover_motion, braking_from_2_m_s_takes_two_metres) {
  body rover{.where = rover_start, .ground_speed_mps = 2};
  int steps = 0;
  for (; rover.ground_speed_mps > 0; ++steps)
    brake(rover, rover_limits, rover_step_s);
  EXPECT_NEAR(steps * rover_step_s, 2, 0.03);
  EXPECT_NEAR(between(rover_start, rover.where).distance_m, 2, 0.05);
}

TEST(sim_rover_motion, at_rest_a_step_changes_nothing) {
  body rover{.where = rover_start, .heading_deg = 33, .track_deg = 33};
  const auto before = rover;
  brake(rover, rover_limits, rover_step_s);
  EXPECT_EQ(rover.where, before.where);
  EXPECT_EQ(rover.heading_deg, before.heading_deg);
  EXPECT_EQ(rover.ground_speed_mps, 0);
}

// The circle that it can drive at 2 m/s has a radius of 2.5 m: a place inside must not be circled for ever.
RC_GTEST_PROP(sim_rover_motion, it_never_circles_a_place, ()) {
  body rover{.where = rover_start,
             .heading_deg = *rc::gen::inRange(0, 360) * 1.0,
             .ground_speed_mps = *rc::gen::inRange(0, 201) / 100.0};
  const auto place = moved(rover_start, {*rc::gen::inRange(0, 360) * 1.0, *rc::gen::inRange(10, 2'000) / 100.0});
  int steps = 0;
  while (between(rover.where, place).distance_m > 0.3) {
    drive_to(rover, place, false);
    RC_ASSERT(++steps < 60 * 50);
  }
}

} // namespace rover_motion_test
} // namespace godwit::sim::test
