#include "programs/godwit-sim/vehicle/world/fixed_wing_motion.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim::test {
namespace fixed_wing_motion_test {

constexpr double wing_step_s = 0.02;
constexpr fixed_wing_limits wing_limits;
constexpr position wing_start{47, 8, 450};

body flying() { return {.where = wing_start, .ground_speed_mps = 15}; }

wing_order order(double course_deg, double altitude_m = wing_start.altitude_m) {
  return {course_deg, 0, altitude_m, 15, 4, 3};
}

TEST(sim_fixed_wing_motion, it_turns_by_banking_within_its_limit_and_never_flies_slower_than_it_must) {
  auto wing = flying();
  for (int step = 0; step < 1'000; ++step) {
    auto wanted = order(170);
    wanted.speed_mps = 2;
    const auto before = wing;
    fly(wing, wing_limits, wanted, wing_step_s);
    EXPECT_LE(std::abs(wing.roll_rad), wing_limits.max_bank_deg * degree + 1e-9);
    EXPECT_GE(wing.ground_speed_mps, wing_limits.min_speed_mps);
    const double fastest_rad_s = 9.80665 * std::tan(wing_limits.max_bank_deg * degree) / wing_limits.min_speed_mps;
    EXPECT_LE(std::abs(turn_of(wing.heading_deg - before.heading_deg)) * degree, fastest_rad_s * wing_step_s + 1e-9);
  }
  EXPECT_NEAR(wing.heading_deg, 170, 0.5);
  EXPECT_NEAR(wing.roll_rad, 0, 0.01);
}

TEST(sim_fixed_wing_motion, its_tightest_circle_is_that_of_a_coordinated_turn) {
  auto wing = flying();
  double west_deg = wing_start.longitude_deg;
  double east_deg = wing_start.longitude_deg;
  for (int step = 0; step < 2'000; ++step) {
    fly(wing, wing_limits, order(wing.heading_deg + 90), wing_step_s);
    west_deg = std::min(west_deg, wing.where.longitude_deg);
    east_deg = std::max(east_deg, wing.where.longitude_deg);
  }
  const double diameter_m = between({47, west_deg, 0}, {47, east_deg, 0}).distance_m;
  EXPECT_NEAR(diameter_m, 2 * 15 * 15 / 9.80665, 3);
}

TEST(sim_fixed_wing_motion, it_climbs_and_sinks_within_its_limits_and_levels_off) {
  for (const double altitude_m : {wing_start.altitude_m + 50, wing_start.altitude_m - 50}) {
    auto wing = flying();
    for (int step = 0; step < 1'500; ++step) {
      fly(wing, wing_limits, order(0, altitude_m), wing_step_s);
      EXPECT_LE(wing.climb_mps, 4 + 1e-9);
      EXPECT_GE(wing.climb_mps, -3 - 1e-9);
    }
    EXPECT_NEAR(wing.where.altitude_m, altitude_m, 0.5);
  }
}

TEST(sim_fixed_wing_motion, without_a_motor_it_comes_down_ahead) {
  auto wing = flying();
  for (int step = 0; step < 500; ++step)
    glide(wing, wing_limits, wing_step_s);
  EXPECT_LT(wing.where.altitude_m, wing_start.altitude_m - 20);
  EXPECT_GE(wing.ground_speed_mps, wing_limits.min_speed_mps);
}

TEST(sim_fixed_wing_motion, on_the_ground_it_rolls_to_a_stop) {
  auto wing = flying();
  int steps = 0;
  for (; wing.ground_speed_mps > 0; ++steps)
    roll(wing, wing_limits, 0, wing_step_s);
  EXPECT_NEAR(steps * wing_step_s, 15 / wing_limits.acceleration_mps2, 0.1);
  EXPECT_EQ(wing.where.altitude_m, wing_start.altitude_m);
}

RC_GTEST_PROP(sim_fixed_wing_motion, from_anywhere_it_comes_to_its_circle_and_stays_on_it, ()) {
  auto wing = flying();
  wing.heading_deg = *rc::gen::inRange(0, 360) * 1.0;
  const auto centre = moved(wing_start, {*rc::gen::inRange(0, 360) * 1.0, *rc::gen::inRange(0, 500) * 1.0});
  const double radius_m = *rc::gen::inRange(40, 120) * (*rc::gen::arbitrary<bool>() ? 1.0 : -1.0);
  for (int step = 0; step < 120 * 50; ++step) {
    const auto to_centre = course_nearby(wing.where, centre);
    const auto circle = course_on_circle(to_centre, radius_m, wing.ground_speed_mps);
    auto wanted = order(circle.course_deg);
    wanted.turn_rate_rad_s = circle.turn_rate_rad_s;
    fly(wing, wing_limits, wanted, wing_step_s);
    if (step > 90 * 50) {
      RC_ASSERT(std::abs(course_nearby(wing.where, centre).distance_m - std::abs(radius_m)) < 5);
      RC_ASSERT((wing.turn_rate_rad_s > 0) == (radius_m > 0));
    }
  }
}

} // namespace fixed_wing_motion_test
} // namespace godwit::sim::test
