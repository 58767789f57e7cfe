#include <gtest/gtest.h>

#include "actors/scan_controller/point.hpp"

namespace matching_test {

using namespace godwit::scan_controller;

point at(double latitude_deg, double longitude_deg) {
  point result;
  result.class_group = "boat";
  result.position = {latitude_deg, longitude_deg, {}};
  return result;
}

candidate seen_at(double latitude_deg, double longitude_deg) {
  candidate result;
  result.class_group = "boat";
  result.position = {latitude_deg, longitude_deg, {}};
  return result;
}

TEST(matching, near_enough_is_the_same_and_farther_is_not) {
  EXPECT_TRUE(is_about(seen_at(47.0, 8.0), at(47.00026, 8.0), 30));
  EXPECT_FALSE(is_about(seen_at(47.0, 8.0), at(47.00028, 8.0), 30));
  EXPECT_FALSE(is_about(seen_at(47.0, 8.0), at(47.0, 8.0005), 30));
}

TEST(matching, across_the_antimeridian_it_is_near) { EXPECT_TRUE(is_about(seen_at(0, 180), at(0, -179.9999), 30)); }

TEST(matching, the_same_object_is_the_same_wherever_it_is) {
  auto known = at(47.0, 8.0);
  known.object_id = "o";
  auto seen = seen_at(48.0, 8.0);
  EXPECT_FALSE(is_about(seen, known, 30));
  seen.object_id = "o";
  EXPECT_TRUE(is_about(seen, known, 30));
  seen.class_group = "person";
  EXPECT_FALSE(is_about(seen, known, 30));
}

} // namespace matching_test

namespace priority_test {

using namespace godwit::scan_controller;
using godwit::geo::point;
using interest = godwit::scan_controller::point;

interest seen(double confidence, std::int64_t seen_ns = 0, bool has_moved = true) {
  interest result;
  result.position = {47.0, 8.0, {}};
  result.confidence = confidence;
  result.seen_ns = seen_ns;
  result.has_moved = has_moved;
  return result;
}

TEST(priority, rises_with_confidence_and_movement_and_falls_with_age_and_distance) {
  const point here{47.0, 8.0};
  EXPECT_DOUBLE_EQ(priority_of(seen(0.8), here, 0), 0.8);
  EXPECT_DOUBLE_EQ(priority_of(seen(0.8, 0, false), here, 0), 0.8 * standing_worth);
  EXPECT_DOUBLE_EQ(priority_of(seen(0.8), here, 60'000'000'000), 0.4);
  EXPECT_NEAR(priority_of(seen(0.8), point{47.0 + 500 / 111'200.0, 8.0}, 0), 0.4, 0.001);
}

TEST(priority, while_nobody_knows_where_the_vehicle_is_all_are_equally_near) {
  EXPECT_DOUBLE_EQ(priority_of(seen(0.8), {}, 0), 0.8);
}

TEST(priority, below_the_threshold_comes_last_and_among_equals_the_older_first) {
  EXPECT_TRUE(goes_before({true, 0.1, 9}, {false, 0.9, 1}));
  EXPECT_TRUE(goes_before({true, 0.5, 1}, {true, 0.5, 2}));
  EXPECT_FALSE(goes_before({true, 0.5, 1}, {true, 0.5, 1}));
}

} // namespace priority_test
