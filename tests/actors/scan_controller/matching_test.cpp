#include "actors/scan_controller/matching.hpp"

#include <gtest/gtest.h>

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
