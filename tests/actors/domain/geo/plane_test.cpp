#include "actors/domain/geo/plane.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/actors/domain/geo/places.hpp"

namespace godwit::geo {
namespace plane_test {

local_point any_point() { return {*tests::number_between(-100, 100), *tests::number_between(-100, 100)}; }

TEST(plane, the_distance_to_a_segment_is_to_its_nearest_place) {
  const segment s{{0, 0}, {10, 0}};
  EXPECT_DOUBLE_EQ(distance_m(local_point{5, 3}, s), 3);
  EXPECT_DOUBLE_EQ(distance_m(local_point{13, 4}, s), 5);
  EXPECT_DOUBLE_EQ(distance_m(local_point{-3, -4}, s), 5);
  EXPECT_DOUBLE_EQ(distance_m(local_point{3, 4}, segment{{0, 0}, {0, 0}}), 5);
}

TEST(plane, segments_that_cross_or_touch_have_no_distance) {
  EXPECT_DOUBLE_EQ(distance_m({{0, 0}, {10, 10}}, {{0, 10}, {10, 0}}), 0);
  EXPECT_DOUBLE_EQ(distance_m({{0, 0}, {10, 0}}, {{10, 0}, {20, 5}}), 0);
  EXPECT_DOUBLE_EQ(distance_m({{0, 0}, {10, 0}}, {{5, 0}, {20, 0}}), 0);
  EXPECT_DOUBLE_EQ(distance_m({{0, 0}, {10, 0}}, {{0, 2}, {10, 3}}), 2);
}

TEST(plane, the_cross_product_is_positive_to_the_left) {
  EXPECT_GT(cross({1, 0}, {0, 1}), 0);
  EXPECT_LT(cross({1, 0}, {0, -1}), 0);
}

RC_GTEST_PROP(plane_property, the_distance_of_segments_does_not_depend_on_their_order, ()) {
  const segment a{any_point(), any_point()};
  const segment b{any_point(), any_point()};
  RC_ASSERT(std::abs(distance_m(a, b) - distance_m(b, a)) < 1e-9);
  RC_ASSERT(distance_m(a, b) <= distance_m(a.from, b) + 1e-9);
}

RC_GTEST_PROP(plane_property, between_two_turning_shares_a_point_is_always_or_never_nearer_than_the_margin, ()) {
  const segment way{any_point(), any_point()};
  const segment side{any_point(), any_point()};
  const double margin_m = *tests::number_between(0.5, 40);
  std::vector<double> shares{0, 1};
  add_turning_shares(way, side, margin_m, shares);
  std::sort(shares.begin(), shares.end());
  for (std::size_t i = 1; i < shares.size(); ++i) {
    const double low = shares[i - 1];
    const double width = shares[i] - low;
    if (width < 1e-6)
      continue;
    const bool is_near = distance_m(at_share(way, low + width / 2), side) < margin_m;
    for (const double part : {0.05, 0.3, 0.7, 0.95})
      RC_ASSERT((distance_m(at_share(way, low + part * width), side) < margin_m) == is_near);
  }
}

} // namespace plane_test
} // namespace godwit::geo
