#include "actors/domain/geo/flat_polygon.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/actors/domain/geo/places.hpp"

namespace godwit::geo {
namespace flat_polygon_test {

const flat_polygon square({{0, 0}, {100, 0}, {100, 100}, {0, 100}});

TEST(flat_polygon, corners_run_counter_clockwise_whatever_they_did_before) {
  const flat_polygon clockwise({{0, 0}, {0, 100}, {100, 100}, {100, 0}});
  const auto corners = clockwise.corners();
  EXPECT_GT(cross(corners[1] - corners[0], corners[2] - corners[1]), 0);
}

TEST(flat_polygon, a_side_and_a_corner_are_inside) {
  EXPECT_TRUE(square.contains({0, 50}));
  EXPECT_TRUE(square.contains({100, 100}));
  EXPECT_TRUE(square.contains({-0.0005, 50}));
  EXPECT_FALSE(square.contains({-0.01, 50}));
}

TEST(flat_polygon, a_dent_is_outside) {
  const flat_polygon dented({{0, 0}, {100, 0}, {100, 100}, {50, 20}, {0, 100}});
  EXPECT_TRUE(dented.contains({10, 70}));
  EXPECT_FALSE(dented.contains({50, 70}));
}

TEST(flat_polygon, the_distance_is_to_the_sides_from_within_and_without) {
  EXPECT_DOUBLE_EQ(square.distance_to_sides_m(local_point{50, 40}), 40);
  EXPECT_DOUBLE_EQ(square.distance_to_sides_m(local_point{130, 50}), 30);
  EXPECT_DOUBLE_EQ(square.distance_to_sides_m(segment{{-50, 50}, {150, 50}}), 0);
  EXPECT_DOUBLE_EQ(square.distance_to_sides_m(segment{{-50, -7}, {150, -7}}), 7);
}

TEST(flat_polygon, who_is_nearer_to_a_side_than_the_margin_is_not_inside_with_it) {
  EXPECT_TRUE(square.contains_with_margin({50, 50}, 49));
  EXPECT_FALSE(square.contains_with_margin({50, 50}, 51));
  EXPECT_FALSE(square.contains_with_margin({150, 50}, 10));
}

TEST(flat_polygon, corners_of_a_mission_are_projected) {
  const local_projection projection({47, 179.9999});
  const std::vector<point> corners{{47, 179.9999}, {47, -179.9990}, {47.001, -179.9990}, {47.001, 179.9999}};
  const flat_polygon area(corners, projection);
  EXPECT_TRUE(area.contains(projection.to_local({47.0005, 180})));
  EXPECT_FALSE(area.contains(projection.to_local({47.0005, 179.9990})));
}

RC_GTEST_PROP(flat_polygon_property, the_quick_question_agrees_with_the_distance, ()) {
  const local_point from{*tests::number_between(-200, 300), *tests::number_between(-200, 300)};
  const local_point to{*tests::number_between(-200, 300), *tests::number_between(-200, 300)};
  const double margin_m = *tests::number_between(0.5, 100);
  RC_ASSERT(square.has_sides_within(margin_m, {from, to}) == (square.distance_to_sides_m({from, to}) < margin_m));
}

RC_GTEST_PROP(flat_polygon_property, between_two_turning_shares_a_point_is_always_or_never_inside_with_the_margin, ()) {
  const flat_polygon dented({{0, 0}, {100, 0}, {100, 100}, {50, 20}, {0, 100}});
  const segment way{{*tests::number_between(-50, 150), *tests::number_between(-50, 150)},
                    {*tests::number_between(-50, 150), *tests::number_between(-50, 150)}};
  const double margin_m = *tests::number_between(0, 15);
  std::vector<double> shares{0, 1};
  dented.add_turning_shares(way, margin_m, shares);
  std::sort(shares.begin(), shares.end());
  for (std::size_t i = 1; i < shares.size(); ++i) {
    const double width = shares[i] - shares[i - 1];
    if (width * length_m(way.to - way.from) < 0.1)
      continue;
    const auto is_in = [&](double part) {
      return dented.contains_with_margin(at_share(way, shares[i - 1] + part * width), margin_m);
    };
    for (const double part : {0.05, 0.3, 0.7, 0.95})
      RC_ASSERT(is_in(part) == is_in(0.5));
  }
}

} // namespace flat_polygon_test
} // namespace godwit::geo
