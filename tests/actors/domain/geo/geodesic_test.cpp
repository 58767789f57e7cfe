#include "actors/domain/geo/geodesic.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/actors/domain/geo/places.hpp"

namespace godwit::geo {
namespace geodesic_test {

// The length of a degree of the equator follows from its radius alone, that of the quarter meridian is published.
TEST(geodesic, published_distances_come_out) {
  EXPECT_NEAR(distance_m(point{0, 0}, point{0, 1}), 111'319.4908, 1e-4);
  EXPECT_NEAR(distance_m(point{0, 16}, point{90, 16}), 10'001'965.7293, 1e-4);
}

TEST(geodesic, the_antimeridian_is_no_distance) {
  EXPECT_NEAR(distance_m(point{10, 180}, point{10, -180}), 0, 1e-9);
  EXPECT_NEAR(distance_m(point{0, 179.9999}, point{0, -179.9999}), 22.26, 0.01);
}

TEST(geodesic, all_longitudes_meet_at_a_pole) { EXPECT_NEAR(distance_m(point{90, 0}, point{90, 77}), 0, 1e-9); }

RC_GTEST_PROP(geodesic_property, the_way_there_is_as_long_as_asked_for, ()) {
  const auto from = *tests::anywhere();
  const double bearing_deg = *tests::number_between(0, 360);
  const double length_m = *tests::number_between(0, 100'000);
  const auto to = destination(from, bearing_deg, length_m);
  RC_ASSERT(is_valid(to));
  RC_ASSERT(std::abs(distance_m(from, to) - length_m) < 1e-6);
  RC_ASSERT(std::abs(distance_m(from, to) - distance_m(to, from)) < 1e-6);
}

} // namespace geodesic_test
} // namespace godwit::geo
