#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/vehicle/world/angle.hpp"
#include "programs/godwit-sim/vehicle/world/nearby.hpp"

namespace godwit::sim::test {

namespace nearby_test {

// Where it is far enough from a pole.
position somewhere() {
  return {*rc::gen::inRange(-79'000, 79'000) / 1e3, *rc::gen::inRange(-180'000, 180'000) / 1e3, 0};
}

RC_GTEST_PROP(sim_nearby, the_way_differs_by_less_than_a_millimetre_in_a_kilometre_from_the_geodesic, ()) {
  const auto from = somewhere();
  const course by{*rc::gen::inRange(0, 360'000) / 1e3, *rc::gen::inRange(1, 1'000'000) / 1e3};
  const auto to = moved(from, by);
  RC_ASSERT(is_nearby(from, to));
  const auto found = course_nearby(from, to);
  RC_ASSERT(std::abs(found.distance_m - by.distance_m) < 1e-3);
  RC_ASSERT(std::abs(turn_of(found.bearing_deg - by.bearing_deg)) * degree * by.distance_m < 1e-3);
}

// As a vehicle that keeps to the great circle does it: each step turns by the convergence of the meridians.
position walked(position from, const course& by, double step_m) {
  double bearing_rad = by.bearing_deg * degree;
  for (double left_m = by.distance_m; left_m > 0; left_m -= step_m) {
    const double way_m = std::min(step_m, left_m);
    const auto to = stepped(from, way_m * std::cos(bearing_rad), way_m * std::sin(bearing_rad));
    bearing_rad += turn_of(to.longitude_deg - from.longitude_deg) * degree * std::sin(to.latitude_deg * degree);
    from = to;
  }
  return from;
}

RC_GTEST_PROP(sim_nearby, a_kilometre_of_steps_ends_within_a_centimetre_of_the_geodesic, ()) {
  const position from{*rc::gen::inRange(-70'000, 70'000) / 1e3, *rc::gen::inRange(-180'000, 180'000) / 1e3, 0};
  const course by{*rc::gen::inRange(0, 360'000) / 1e3, 1'000};
  const double step_m = *rc::gen::inRange(4, 40) / 100.0; // 2 to 20 m/s, 50 times a second
  RC_ASSERT(between(walked(from, by, step_m), moved(from, by)).distance_m < 0.01);
}

TEST(sim_nearby, over_the_date_line_the_way_is_short) {
  const position west{52, 179.9999, 0};
  const auto east = stepped(west, 0, 9);
  EXPECT_LT(east.longitude_deg, 0);
  EXPECT_NEAR(course_nearby(west, east).distance_m, 9, 1e-4);
  EXPECT_NEAR(course_nearby(west, east).bearing_deg, 90, 1e-3);
  EXPECT_NEAR(course_nearby(east, west).bearing_deg, 270, 1e-3);
}

TEST(sim_nearby, near_a_pole_steps_are_exact_and_places_are_not_nearby) {
  const position north{89.99995, 10, 0};
  EXPECT_FALSE(is_nearby(north, north));
  const auto beyond = stepped(north, max_step_m, 0);
  EXPECT_NEAR(between(north, beyond).distance_m, max_step_m, 1e-9);
  EXPECT_NEAR(std::abs(turn_of(beyond.longitude_deg - 10)), 180, 1e-6);
}

TEST(sim_nearby, of_no_distance_the_bearing_is_0) {
  EXPECT_EQ(course_nearby({47, 8, 0}, {47, 8, 0}).bearing_deg, 0);
  EXPECT_EQ(course_nearby({47, 8, 0}, {47, 8, 0}).distance_m, 0);
}

} // namespace nearby_test

namespace way_test {

RC_GTEST_PROP(sim_way, who_steps_along_it_arrives_from_anywhere, ()) {
  position here{*rc::gen::inRange(-89'000, 89'000) / 1e3, *rc::gen::inRange(-180'000, 180'000) / 1e3, 0};
  way home(moved(here, {*rc::gen::inRange(0, 360'000) / 1e3, 15'000}));
  int steps = 0;
  for (auto course = home.from(here); course.distance_m > 2; course = home.from(here)) {
    RC_ASSERT(++steps < 15'000 / 8);
    const double bearing_rad = course.bearing_deg * degree;
    const double step_m = std::min(10.0, course.distance_m);
    here = stepped(here, step_m * std::cos(bearing_rad), step_m * std::sin(bearing_rad));
  }
}

TEST(sim_way, far_away_an_answer_serves_for_a_second_of_steps) {
  const position start{47, 8, 0};
  way far(moved(start, {0, 50'000}));
  const double first_m = far.from(start).distance_m;
  position here = start;
  int answers = 1;
  for (; far.from(here).distance_m == first_m; ++answers)
    here = stepped(here, 1, 0);
  EXPECT_EQ(answers, 50);
}

} // namespace way_test

} // namespace godwit::sim::test
