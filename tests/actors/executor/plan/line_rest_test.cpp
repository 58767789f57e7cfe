// Where a line goes on that was left before its end.
#include "actors/executor/plan/line_rest.hpp"

#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/executor/plan/places.hpp"
#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace line_rest_test {

geo::point point(double east_m, double north_m) { return point_of(at(east_m, north_m, 0)); }

TEST(line_rest, a_line_goes_on_beside_its_last_picture) {
  const auto along = [](double east_m, double north_m) {
    return way_along(point(100, 50), point(300, 50), point(east_m, north_m));
  };
  ASSERT_TRUE(along(180, 55));
  EXPECT_NEAR(*along(180, 55), 80, 0.2);
  EXPECT_NEAR(*along(320, 50), 200, 0.2) << "its end at most";
  EXPECT_FALSE(along(100, 50)) << "at its beginning";
  EXPECT_FALSE(along(90, 50)) << "before it";
  EXPECT_FALSE(along(180, 62)) << "of another line";
}

TEST(line_rest, a_place_on_a_line_that_climbs_is_as_high_as_the_line) {
  const auto there = place_along(at(0, 0, 20), at(100, 0, 40), 25);
  EXPECT_NEAR(there.altitude_m, 25, 0.1);
  EXPECT_NEAR(geo::distance_m(point_of(there), point(25, 0)), 0, 0.1);
  EXPECT_NEAR(place_along(at(0, 0, 20), at(0, 0, 40), 0).altitude_m, 20, 20) << "of no length";
}

} // namespace line_rest_test
} // namespace godwit::executor::plan
