#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "actors/failsafe/fence.hpp"
#include "tests/actors/failsafe/fences.hpp"

namespace {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::mission::fence_kind;

fence built(const godwit::mission::geofence& from) { return fence::build(from).value(); }

std::string refusal_of(const godwit::mission::geofence& from) {
  const auto result = fence::build(from);
  return result ? std::string() : result.error();
}

TEST(fence, inside_is_between_the_corners) {
  const auto area = built(fence_of(fence_kind::inclusion, square(100)));
  EXPECT_TRUE(area.contains(place_at(0, 0), true));
  EXPECT_FALSE(area.contains(place_at(101, 0), true));
}

TEST(fence, on_the_edge_is_inside_for_both_kinds) {
  for (const auto kind : {fence_kind::inclusion, fence_kind::exclusion}) {
    const auto area = built(fence_of(kind, square(100)));
    EXPECT_TRUE(area.contains(place_at(100, 0), true));
    EXPECT_TRUE(area.contains(place_at(100, 100), true)) << "a corner";
    EXPECT_FALSE(area.contains(place_at(100.01, 0), true));
  }
}

TEST(fence, floor_and_ceiling_belong_to_the_inside) {
  const auto area = built(fence_of(fence_kind::inclusion, square(100), 20, 120));
  EXPECT_TRUE(area.contains(place_at(0, 0, 20), true));
  EXPECT_TRUE(area.contains(place_at(0, 0, 120), true));
  EXPECT_FALSE(area.contains(place_at(0, 0, 19.9), true));
  EXPECT_FALSE(area.contains(place_at(0, 0, 120.1), true));
}

TEST(fence, without_floor_and_ceiling_it_has_all_heights) {
  const auto area = built(fence_of(fence_kind::exclusion, square(100)));
  EXPECT_TRUE(area.contains(place_at(0, 0, -500), true));
  EXPECT_TRUE(area.contains(place_at(0, 0, 9'000), true));
}

TEST(fence, a_floor_that_does_not_count_leaves_the_ceiling) {
  const auto area = built(fence_of(fence_kind::inclusion, square(100), 20, 120));
  EXPECT_TRUE(area.contains(place_at(0, 0, 0), false));
  EXPECT_FALSE(area.contains(place_at(0, 0, 121), false));
}

TEST(fence, it_may_lie_across_the_antimeridian) {
  const auto area = built(fence_of(fence_kind::inclusion, square(200), {}, {}, near_antimeridian));
  EXPECT_TRUE(area.contains(place_at(-150, 0, 50, near_antimeridian), true));
  const auto other_side = place_at(150, 0, 50, near_antimeridian);
  EXPECT_LT(other_side.at.longitude_deg, 0);
  EXPECT_TRUE(area.contains(other_side, true));
  EXPECT_FALSE(area.contains(place_at(250, 0, 50, near_antimeridian), true));
  EXPECT_FALSE(area.contains(place_at(-250, 0, 50, near_antimeridian), true));
}

TEST(fence, a_concave_area_has_a_bay_that_is_outside) {
  const auto area = built(fence_of(fence_kind::inclusion, {{0, 0}, {100, 0}, {100, 100}, {50, 20}, {0, 100}}));
  EXPECT_FALSE(area.contains(place_at(50, 60), true));
  EXPECT_TRUE(area.contains(place_at(50, 10), true));
}

TEST(fence, a_leg_is_cut_where_it_passes_a_side) {
  const auto area = built(fence_of(fence_kind::exclusion, square(10)));
  const auto leg = area.leg_between(place_at(-20, 0), place_at(20, 0));
  std::vector<double> shares;
  leg.add_cuts(shares);
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_NEAR(std::min(shares[0], shares[1]), 0.25, 1e-6);
  EXPECT_NEAR(std::max(shares[0], shares[1]), 0.75, 1e-6);
  EXPECT_TRUE(leg.is_inside(0.5, true));
  EXPECT_FALSE(leg.is_inside(0.2, true));
}

TEST(fence, a_leg_is_cut_where_it_passes_the_ceiling) {
  const auto area = built(fence_of(fence_kind::inclusion, square(100), {}, 100));
  const auto leg = area.leg_between(place_at(0, 0, 90), place_at(0, 1, 110));
  std::vector<double> shares;
  leg.add_cuts(shares);
  ASSERT_EQ(shares.size(), 1U);
  EXPECT_NEAR(shares[0], 0.5, 1e-6);
}

TEST(fence, a_leg_far_away_costs_nothing) {
  const auto area = built(fence_of(fence_kind::exclusion, square(10)));
  const auto leg = area.leg_between(place_at(1'000, 0), place_at(1'010, 0));
  std::vector<double> shares;
  leg.add_cuts(shares);
  EXPECT_TRUE(shares.empty());
  EXPECT_FALSE(leg.is_inside(0.5, true));
}

TEST(fence, what_is_no_area_is_refused_with_a_sentence) {
  EXPECT_NE(refusal_of(fence_of(fence_kind::inclusion, {{0, 0}, {1, 0}})).find("at least 3"), std::string::npos);
  EXPECT_NE(refusal_of(fence_of(fence_kind::inclusion, square(10), 50, 40)).find("floor above"), std::string::npos);
  auto nowhere = fence_of(fence_kind::inclusion, square(10));
  nowhere.vertices[1].latitude = 91;
  EXPECT_NE(refusal_of(nowhere).find("no place"), std::string::npos);
  nowhere.vertices[1].latitude = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal_of(nowhere).find("no place"), std::string::npos);
  const auto no_height = fence_of(fence_kind::inclusion, square(10), std::numeric_limits<double>::infinity());
  EXPECT_NE(refusal_of(no_height).find("not a number"), std::string::npos);
  auto many = fence_of(fence_kind::inclusion, square(10));
  many.vertices.resize(max_fence_corners + 1);
  EXPECT_NE(refusal_of(many).find("at most 256"), std::string::npos);
}

} // namespace
