#include "actors/domain/mission/convert/fence_import.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/mission/polygon_rules.hpp"
#include "tests/actors/domain/mission/mission_maker.hpp"

namespace godwit::mission {
namespace fence_import_test {

// Local metres on the WGS 84 ellipsoid, from its two radii of curvature at CENTRE's latitude.
double metres_between(const vertex& centre, const vertex& other) {
  constexpr double semi_major_m = 6'378'137;
  constexpr double eccentricity_squared = 0.00669437999014;
  const auto radians = std::numbers::pi / 180;
  const auto middle = (centre.latitude + other.latitude) / 2 * radians;
  const auto w = std::sqrt(1 - eccentricity_squared * std::sin(middle) * std::sin(middle));
  const auto meridian_m = semi_major_m * (1 - eccentricity_squared) / (w * w * w);
  const auto north = (other.latitude - centre.latitude) * radians * meridian_m;
  const auto east =
      std::remainder(other.longitude - centre.longitude, 360) * radians * semi_major_m / w * std::cos(middle);
  return std::hypot(north, east);
}

vertex middle_of(const vertex& a, const vertex& b) {
  return {(a.latitude + b.latitude) / 2, a.longitude + std::remainder(b.longitude - a.longitude, 360) / 2};
}

RC_GTEST_PROP(fence_import_property, an_inclusion_lies_within_its_circle_and_an_exclusion_around_it, ()) {
  mission_maker maker(*rc::gen::arbitrary<std::uint64_t>());
  const vertex centre{maker.number(-79, 79), maker.number(-180, 180)};
  const auto radius_m = maker.number(1, 5000);
  const auto inner = polygon_of_circle(centre, radius_m, fence_kind::inclusion).value();
  const auto outer = polygon_of_circle(centre, radius_m, fence_kind::exclusion).value();
  RC_ASSERT(!polygon_fault(inner));
  RC_ASSERT(!polygon_fault(outer));
  for (std::size_t i = 0; i < inner.size(); ++i) {
    RC_ASSERT(metres_between(centre, inner[i]) <= radius_m * 1.0001);
    RC_ASSERT(metres_between(centre, inner[i]) >= radius_m * 0.97);
    RC_ASSERT(metres_between(centre, middle_of(outer[i], outer[(i + 1) % outer.size()])) >= radius_m * 0.9999);
    RC_ASSERT(metres_between(centre, outer[i]) <= radius_m * 1.04);
  }
}

TEST(fence_import, no_polygon_near_a_pole_or_for_a_radius_that_is_none) {
  EXPECT_EQ(polygon_of_circle({85, 0}, 100, fence_kind::inclusion), std::nullopt);
  EXPECT_EQ(polygon_of_circle({0, 0}, 0, fence_kind::inclusion), std::nullopt);
  EXPECT_EQ(polygon_of_circle({0, 0}, 1e9, fence_kind::inclusion), std::nullopt);
  EXPECT_EQ(polygon_of_circle({std::nan(""), 0}, 5, fence_kind::inclusion), std::nullopt);
  EXPECT_EQ(polygon_of_circle({0, 0}, std::nan(""), fence_kind::inclusion), std::nullopt);
}

} // namespace fence_import_test
} // namespace godwit::mission
