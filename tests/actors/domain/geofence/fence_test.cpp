#include "actors/domain/geofence/fence.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/actors/domain/geofence/fences.hpp"

namespace fence_test {

using namespace godwit::geofence;
using namespace godwit::tests;
using godwit::mission::fence_kind;

fence built(const godwit::mission::geofence& from) { return fence::build(from).value(); }

std::string refusal_of(const godwit::mission::geofence& from) {
  const auto result = fence::build(from);
  return result ? std::string() : result.error();
}

TEST(fence, inside_is_between_the_corners) {
  const auto area = built(fence_of(fence_kind::inclusion, square(100)));
  EXPECT_TRUE(area.area().contains(place_at(0, 0).at));
  EXPECT_FALSE(area.area().contains(place_at(101, 0).at));
}

TEST(fence, on_the_edge_is_inside_for_both_kinds) {
  for (const auto kind : {fence_kind::inclusion, fence_kind::exclusion}) {
    const auto area = built(fence_of(kind, square(100)));
    EXPECT_TRUE(area.area().contains(place_at(100, 0).at));
    EXPECT_TRUE(area.area().contains(place_at(100, 100).at)) << "a corner";
    EXPECT_FALSE(area.area().contains(place_at(100.01, 0).at));
  }
}

TEST(fence, floor_and_ceiling_belong_to_the_inside) {
  const auto altitudes = built(fence_of(fence_kind::inclusion, square(100), 20, 120)).altitudes();
  EXPECT_TRUE(altitudes.contains(20));
  EXPECT_TRUE(altitudes.contains(120));
  EXPECT_FALSE(altitudes.contains(19.9));
  EXPECT_FALSE(altitudes.contains(120.1));
}

TEST(fence, without_floor_and_ceiling_it_has_all_heights) {
  const auto altitudes = built(fence_of(fence_kind::exclusion, square(100))).altitudes();
  EXPECT_TRUE(altitudes.contains(-500));
  EXPECT_TRUE(altitudes.contains(9'000));
}

TEST(fence, it_may_lie_across_the_antimeridian) {
  const auto area = built(fence_of(fence_kind::inclusion, square(200), {}, {}, near_antimeridian));
  EXPECT_TRUE(area.area().contains(place_at(-150, 0, 50, near_antimeridian).at));
  const auto other_side = place_at(150, 0, 50, near_antimeridian);
  EXPECT_LT(other_side.at.longitude_deg, 0);
  EXPECT_TRUE(area.area().contains(other_side.at));
  EXPECT_FALSE(area.area().contains(place_at(250, 0, 50, near_antimeridian).at));
  EXPECT_FALSE(area.area().contains(place_at(-250, 0, 50, near_antimeridian).at));
}

TEST(fence, a_concave_area_has_a_bay_that_is_outside) {
  const auto area = built(fence_of(fence_kind::inclusion, {{0, 0}, {100, 0}, {100, 100}, {50, 20}, {0, 100}}));
  EXPECT_FALSE(area.area().contains(place_at(50, 60).at));
  EXPECT_TRUE(area.area().contains(place_at(50, 10).at));
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

} // namespace fence_test
