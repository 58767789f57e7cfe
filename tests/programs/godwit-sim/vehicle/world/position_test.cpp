#include "programs/godwit-sim/vehicle/world/position.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/vehicle/world/angle.hpp"

namespace godwit::sim::test {
namespace position_test {

// The line from Flinders Peak to Buninyong, published with Vincenty's formulas, on an ellipsoid 0.1 mm different here.
TEST(sim_position, a_published_geodesic_comes_out_to_the_millimetre) {
  const position flinders_peak{-(37 + 57 / 60.0 + 3.72030 / 3600), 144 + 25 / 60.0 + 29.52440 / 3600, 0};
  const position buninyong{-(37 + 39 / 60.0 + 10.15610 / 3600), 143 + 55 / 60.0 + 35.38390 / 3600, 0};
  const auto way = between(flinders_peak, buninyong);
  EXPECT_NEAR(way.distance_m, 54'972.271, 0.001);
  EXPECT_NEAR(way.bearing_deg, 306 + 52 / 60.0 + 5.37 / 3600, 1e-5);
}

TEST(sim_position, of_no_distance_the_bearing_is_0) {
  const position here{47, 8, 400};
  EXPECT_EQ(between(here, here).distance_m, 0);
  EXPECT_EQ(between(here, here).bearing_deg, 0);
}

TEST(sim_position, the_altitude_stays) { EXPECT_EQ(moved({47, 8, 400}, {90, 1'000}).altitude_m, 400); }

RC_GTEST_PROP(sim_position, the_way_to_where_one_has_moved_is_the_way_moved, ()) {
  const position from{*rc::gen::inRange(-89'000, 89'000) / 1e3, *rc::gen::inRange(-180'000, 180'000) / 1e3, 0};
  const course by{*rc::gen::inRange(0, 360'000) / 1e3, *rc::gen::inRange(1, 100'000'000) / 1e3};
  const auto found = between(from, moved(from, by));
  RC_ASSERT(std::abs(found.distance_m - by.distance_m) < 1e-6);
  // Of a short way the bearing is less certain.
  RC_ASSERT(std::abs(turn_of(found.bearing_deg - by.bearing_deg)) * degree * by.distance_m < 1e-5);
}

} // namespace position_test
} // namespace godwit::sim::test
