#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/motions.hpp"
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

namespace multirotor_motion_test {

constexpr double rotor_step_s = 0.02;
constexpr multirotor_limits rotor_limits;
constexpr position rotor_start{47, 8, 450};

struct over_ground {
  double north;
  double east;
};

over_ground velocity(const body& of) {
  return {of.ground_speed_mps * std::cos(of.track_deg * degree), of.ground_speed_mps * std::sin(of.track_deg * degree)};
}

void fly_to(body& it, const position& place, bool stops = true) {
  fly(it, rotor_limits, {course_nearby(it.where, place), place.altitude_m, 5, 2.5, 1.5, stops}, rotor_step_s);
}

double away_m(const body& it, const position& place) {
  return std::hypot(course_nearby(it.where, place).distance_m, it.where.altitude_m - place.altitude_m);
}

TEST(sim_multirotor_motion, it_keeps_its_speeds_and_accelerations) {
  body it{.where = rotor_start};
  auto place = moved(rotor_start, {70, 60});
  place.altitude_m += 20;
  for (int step = 0; step < 2'000; ++step) {
    const body before = it;
    fly_to(it, place);
    EXPECT_LE(it.ground_speed_mps, 5 + 1e-9);
    EXPECT_LE(it.climb_mps, 2.5);
    const auto was = velocity(before);
    const auto is = velocity(it);
    EXPECT_LE(std::hypot(is.north - was.north, is.east - was.east),
              rotor_limits.acceleration_mps2 * rotor_step_s + 1e-9);
    EXPECT_LE(std::abs(turn_of(it.heading_deg - before.heading_deg)),
              rotor_limits.turn_rate_deg_s * rotor_step_s + 1e-9);
  }
  EXPECT_LT(away_m(it, place), 0.1);
  EXPECT_EQ(it.ground_speed_mps, 0);
  EXPECT_EQ(it.climb_mps, 0);
  EXPECT_EQ(it.where.altitude_m, place.altitude_m);
}

TEST(sim_multirotor_motion, up_and_over_ground_it_arrives_at_the_same_time) {
  body it{.where = rotor_start};
  auto place = moved(rotor_start, {0, 20});
  place.altitude_m += 40;
  for (int step = 0; step < 500; ++step)
    fly_to(it, place);
  EXPECT_NEAR((it.where.altitude_m - rotor_start.altitude_m) / 40, between(rotor_start, it.where).distance_m / 20,
              0.05);
}

TEST(sim_multirotor_motion, it_leans_into_what_it_does_and_is_level_at_rest) {
  body it{.where = rotor_start};
  const auto north = moved(rotor_start, {0, 100});
  for (int step = 0; step < 40; ++step)
    fly_to(it, north);
  EXPECT_LT(it.pitch_rad, -0.15); // nose down to go
  EXPECT_NEAR(it.roll_rad, 0, 1e-6);
  body sideways{.where = rotor_start, .heading_deg = 0};
  fly_to(sideways, moved(rotor_start, {90, 100}));
  EXPECT_GT(sideways.roll_rad, 0); // to the right
  for (int step = 0; step < 3'000; ++step)
    fly_to(it, north);
  EXPECT_EQ(it.pitch_rad, 0);
  EXPECT_EQ(it.roll_rad, 0);
}

TEST(sim_multirotor_motion, its_nose_turns_to_where_it_flies) {
  body it{.where = rotor_start, .heading_deg = 200};
  for (int step = 0; step < 150; ++step)
    fly_to(it, moved(rotor_start, {20, 100}));
  EXPECT_NEAR(it.heading_deg, 20, 0.1);
}

RC_GTEST_PROP(sim_multirotor_motion, it_comes_to_every_place_from_every_motion, ()) {
  body it{.where = rotor_start,
          .ground_speed_mps = *rc::gen::inRange(0, 2'000) / 100.0,
          .track_deg = *rc::gen::inRange(0, 360) * 1.0,
          .climb_mps = *rc::gen::inRange(-200, 200) / 100.0};
  auto place = moved(rotor_start, {*rc::gen::inRange(0, 360) * 1.0, *rc::gen::inRange(10, 5'000) / 100.0});
  place.altitude_m += *rc::gen::inRange(-20, 20);
  const bool stops = *rc::gen::arbitrary<bool>();
  int steps = 0;
  while (away_m(it, place) > 0.5) {
    fly_to(it, place, stops);
    RC_ASSERT(++steps < 90 * 50);
  }
}

TEST(sim_multirotor_motion, a_hover_brakes_and_then_stays_to_the_bit) {
  body it{.where = rotor_start, .ground_speed_mps = 5, .track_deg = 45, .climb_mps = 2};
  for (int step = 0; step < 300; ++step)
    hover(it, rotor_limits, rotor_step_s);
  EXPECT_NEAR(between(rotor_start, it.where).distance_m, 5 * 5 / (2 * rotor_limits.acceleration_mps2), 0.1);
  const auto stays = it.where;
  hover(it, rotor_limits, rotor_step_s);
  EXPECT_EQ(it.where, stays);
}

TEST(sim_multirotor_motion, it_sinks_as_fast_as_it_is_told_and_falls_faster) {
  body sinking{.where = rotor_start};
  body falling{.where = rotor_start};
  for (int step = 0; step < 100; ++step) {
    sink(sinking, rotor_limits, 1.5, rotor_step_s);
    fall(falling, rotor_step_s);
  }
  EXPECT_NEAR(sinking.climb_mps, -1.5, 1e-9);
  EXPECT_NEAR(falling.climb_mps, -19.6, 0.1);
  EXPECT_NEAR(falling.where.altitude_m, rotor_start.altitude_m - 19.6, 0.1);
}

} // namespace multirotor_motion_test

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
