#include "actors/domain/geo/distance_text.hpp"

#include <gtest/gtest.h>

namespace godwit::geo {
namespace distance_text_test {

TEST(distance_text, is_rounded_as_people_say_it) {
  EXPECT_EQ(distance_text(0), "0 m");
  EXPECT_EQ(distance_text(99.4), "99 m");
  EXPECT_EQ(distance_text(99.6), "100 m");
  EXPECT_EQ(distance_text(354), "350 m");
  EXPECT_EQ(distance_text(996), "1 km");
  EXPECT_EQ(distance_text(12'449), "12.4 km");
  EXPECT_EQ(distance_text(50'000), "50 km");
  EXPECT_EQ(distance_text(99'960), "100 km");
  EXPECT_EQ(distance_text(999'600), "1,000 km");
  EXPECT_EQ(distance_text(16'561'234), "16,600 km");
}

TEST(distance_text, directions_are_the_eight_points_of_the_compass) {
  EXPECT_EQ(direction_text(0), "north");
  EXPECT_EQ(direction_text(-10), "north");
  EXPECT_EQ(direction_text(350), "north");
  EXPECT_EQ(direction_text(30), "north-east");
  EXPECT_EQ(direction_text(-45), "north-west");
  EXPECT_EQ(direction_text(180), "south");
  EXPECT_EQ(direction_text(-180), "south");
  EXPECT_EQ(direction_text(130), "south-east");
}

TEST(distance_text, long_numbers_are_grouped) {
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(11'000), "11,000");
  EXPECT_EQ(grouped(-1'234'567), "-1,234,567");
  EXPECT_EQ(grouped(-0.2), "0");
}

} // namespace distance_text_test
} // namespace godwit::geo
