#include "actors/domain/geo/local_projection.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/domain/geo/places.hpp"

namespace godwit::geo {
namespace local_projection_test {

TEST(local_projection, east_is_east_also_across_the_antimeridian) {
  const local_projection flat({0, 179.9999});
  const auto there = flat.to_local({0, -179.9999});
  EXPECT_NEAR(there.east_m, 22.26, 0.01);
  EXPECT_NEAR(there.north_m, 0, 1e-6);
}

RC_GTEST_PROP(local_projection_property, there_and_back_is_the_same_place, ()) {
  const local_projection flat(*tests::anywhere());
  const auto at = destination(flat.to_globe({}), *tests::number_between(0, 360), *tests::number_between(0, 20'000));
  RC_ASSERT(distance_m(flat.to_globe(flat.to_local(at)), at) < 1e-5);
}

RC_GTEST_PROP(local_projection_property, distances_within_10_km_are_true_to_a_millionth, ()) {
  const auto origin = *tests::anywhere();
  const local_projection flat(origin);
  const auto a = destination(origin, *tests::number_between(0, 360), *tests::number_between(0, 10'000));
  const auto b = destination(origin, *tests::number_between(0, 360), *tests::number_between(0, 10'000));
  const auto on_map_a = flat.to_local(a);
  const auto on_map_b = flat.to_local(b);
  const double on_map_m = std::hypot(on_map_a.east_m - on_map_b.east_m, on_map_a.north_m - on_map_b.north_m);
  const double true_m = distance_m(a, b);
  RC_ASSERT(std::abs(on_map_m - true_m) <= 1e-6 * true_m + 1e-5);
}

} // namespace local_projection_test
} // namespace godwit::geo
