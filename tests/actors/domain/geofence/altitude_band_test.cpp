#include "actors/domain/geofence/altitude_band.hpp"

#include <gtest/gtest.h>

namespace godwit::geofence {
namespace altitude_band_test {

TEST(altitude_band, both_ends_belong_to_it) {
  constexpr altitude_band band{20, 50};
  EXPECT_TRUE(band.contains(20));
  EXPECT_TRUE(band.contains(50));
  EXPECT_FALSE(band.contains(50.001));
  EXPECT_TRUE(band.meets({50, 60}));
  EXPECT_FALSE(band.meets({51, 60}));
  EXPECT_TRUE(band.has_all_of({20, 50}));
  EXPECT_FALSE(band.has_all_of({19, 50}));
}

TEST(altitude_band, without_bounds_it_has_all_altitudes) {
  EXPECT_TRUE(altitude_band{}.contains(-1e9));
  EXPECT_TRUE(altitude_band{}.has_all_of({-500, 9'000}));
}

TEST(altitude_band, every_band_has_all_of_no_altitudes) {
  EXPECT_TRUE(altitude_band{}.has_all_of(no_altitudes));
  EXPECT_TRUE((altitude_band{20, 20}.has_all_of(no_altitudes)));
}

} // namespace altitude_band_test
} // namespace godwit::geofence
