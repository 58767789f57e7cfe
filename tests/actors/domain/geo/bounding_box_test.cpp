#include "actors/domain/geo/bounding_box.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/domain/geo/places.hpp"

namespace godwit::geo {
namespace bounding_box_test {

bool any_contains(const std::vector<bounding_box>& boxes, const point& at) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const bounding_box& each) { return each.contains(at); });
}

TEST(bounding_box, across_the_antimeridian_there_are_two_boxes) {
  const auto boxes = boxes_around({0, 179.9999}, 30);
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_TRUE(any_contains(boxes, {0, -179.9999}));
  EXPECT_FALSE(any_contains(boxes, {0, -179.99}));
  EXPECT_FALSE(any_contains(boxes, {0, 0}));
}

TEST(bounding_box, around_a_pole_the_box_has_all_longitudes) {
  const auto boxes = boxes_around({89.9999, 10}, 30);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_TRUE(boxes.front().contains({89.99995, -170}));
  EXPECT_FALSE(boxes.front().contains({89.9990, 10}));
}

TEST(bounding_box, the_box_is_hardly_larger_than_the_circle) {
  const auto boxes = boxes_around({48, 16}, 1000);
  ASSERT_EQ(boxes.size(), 1U);
  const auto& box = boxes.front();
  EXPECT_LT(distance_m({box.south_deg, 16}, {box.north_deg, 16}), 2020);
  EXPECT_LT(distance_m({48, box.west_deg}, {48, box.east_deg}), 2020);
}

RC_GTEST_PROP(bounding_box_property, whatever_lies_within_the_radius_is_in_a_box, ()) {
  const auto centre = *tests::anywhere();
  const double radius_m = *rc::gen::oneOf(tests::number_between(0, 100), tests::number_between(0, 100'000));
  const double bearing_deg = *tests::number_between(0, 360);
  const auto boxes = boxes_around(centre, radius_m);
  RC_ASSERT(!boxes.empty() && boxes.size() <= 2);
  for (const auto& box : boxes)
    RC_ASSERT(box.west_deg <= box.east_deg && box.south_deg <= box.north_deg && box.west_deg >= -180 &&
              box.east_deg <= 180);
  auto at = destination(centre, bearing_deg, radius_m * *tests::number_between(0, 1));
  RC_ASSERT(any_contains(boxes, at));
  if (std::abs(at.longitude_deg) == 180) {
    at.longitude_deg = -at.longitude_deg;
    RC_ASSERT(any_contains(boxes, at));
  }
}

} // namespace bounding_box_test
} // namespace godwit::geo
