#include "actors/domain/geo/point.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace godwit::geo {
namespace point_test {

TEST(point, the_poles_and_both_names_of_the_antimeridian_are_places) {
  for (const auto& at : {point{90, 180}, point{-90, -180}, point{0, 0}})
    EXPECT_TRUE(is_valid(at));
}

TEST(point, what_is_beyond_or_not_a_number_is_no_place) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& at : {point{90.0001, 0}, point{0, -180.0001}, point{nan, 0}, point{0, nan}, point{infinity, 0}})
    EXPECT_FALSE(is_valid(at));
}

} // namespace point_test
} // namespace godwit::geo
