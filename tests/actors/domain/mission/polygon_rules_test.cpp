#include "actors/domain/mission/polygon_rules.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/actors/domain/mission/mission_maker.hpp"

namespace godwit::mission {
namespace polygon_rules_test {

using corners = std::vector<vertex>;

TEST(polygon_rules, a_square_is_a_polygon) {
  EXPECT_EQ(polygon_fault(corners{{0, 0}, {0, 1}, {1, 1}, {1, 0}}), std::nullopt);
}

TEST(polygon_rules, edges_that_cross_are_named) {
  EXPECT_EQ(polygon_fault(corners{{0, 0}, {1, 1}, {0, 1}, {1, 0}}), "has edges 0 and 2 that cross or touch");
}

TEST(polygon_rules, a_corner_on_another_edge_is_named) {
  EXPECT_EQ(polygon_fault(corners{{0, 0}, {0, 4}, {4, 4}, {0, 2}, {4, 0}}), "has edges 0 and 2 that cross or touch");
}

TEST(polygon_rules, corners_on_one_line_are_no_polygon) {
  EXPECT_EQ(polygon_fault(corners{{0, 0}, {1, 1}, {2, 2}}), "has edges 1 and 2 that lie on each other");
}

TEST(polygon_rules, an_edge_that_goes_back_along_the_one_before_is_refused) {
  EXPECT_EQ(polygon_fault(corners{{0, 0}, {0, 4}, {0, 2}, {2, 2}}), "has edges 0 and 1 that lie on each other");
}

TEST(polygon_rules, a_corner_that_stands_twice_is_named) {
  EXPECT_EQ(polygon_fault(corners{{0, 0}, {0, 1}, {1, 1}, {0, 0}}), "has corner 3 at the place of corner 0");
}

TEST(polygon_rules, two_corners_are_no_polygon) { EXPECT_EQ(polygon_fault(corners{{0, 0}, {0, 1}}), "has 2 corners"); }

TEST(polygon_rules, a_polygon_may_lie_over_the_180th_meridian) {
  EXPECT_EQ(polygon_fault(corners{{0, 179}, {0, -179}, {1, -179}, {1, 179}}), std::nullopt);
  EXPECT_EQ(polygon_fault(corners{{0, 179}, {1, -179}, {1, 179}, {0, -179}}), "has edges 0 and 2 that cross or touch");
  EXPECT_EQ(polygon_fault(corners{{0, 180}, {1, 179}, {0, -180}}), "has corner 2 at the place of corner 0");
}

TEST(polygon_rules, a_fence_may_cross_itself_and_have_a_corner_twice_and_has_three_different_ones) {
  EXPECT_EQ(fence_fault(corners{{0, 0}, {1, 1}, {0, 1}, {1, 0}}), std::nullopt);
  EXPECT_EQ(fence_fault(corners{{0, 0}, {0, 1}, {1, 1}, {0, 0}, {-1, 0}}), std::nullopt);
  EXPECT_EQ(fence_fault(corners{{0, 180}, {1, 179}, {0, -180}, {1, 179}}), "has 2 different corners");
}

TEST(polygon_rules, the_sign_of_the_area_tells_the_direction) {
  EXPECT_GT(signed_area(corners{{0, 179}, {0, -179}, {1, -179}}), 0);
  EXPECT_LT(signed_area(corners{{0, 179}, {1, -179}, {0, -179}}), 0);
}

RC_GTEST_PROP(polygon_rules_property, the_verdict_depends_neither_on_the_first_corner_nor_on_the_direction, ()) {
  mission_maker maker(*rc::gen::arbitrary<std::uint64_t>());
  auto polygon = maker.polygon();
  if (*rc::gen::arbitrary<bool>()) // often makes edges cross
    std::swap(polygon.front(), polygon.at(polygon.size() / 2));
  const bool is_polygon = !polygon_fault(polygon);
  auto turned = polygon;
  const auto first = turned.begin() + maker.whole(0, static_cast<int>(turned.size()) - 1);
  std::rotate(turned.begin(), first, turned.end());
  RC_ASSERT(!polygon_fault(turned) == is_polygon);
  std::ranges::reverse(turned);
  RC_ASSERT(!polygon_fault(turned) == is_polygon);
}

RC_GTEST_PROP(polygon_rules_property, corners_in_order_around_a_middle_are_a_polygon, ()) {
  mission_maker maker(*rc::gen::arbitrary<std::uint64_t>());
  const auto fault = polygon_fault(maker.polygon());
  RC_ASSERT(!fault);
}

} // namespace polygon_rules_test
} // namespace godwit::mission
