#include "programs/godwit-sim/vehicle/world/multirotor_motion.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim::test {
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
} // namespace godwit::sim::test
