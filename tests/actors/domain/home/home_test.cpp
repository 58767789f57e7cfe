#include "actors/domain/home/home.hpp"

#include <gtest/gtest.h>

namespace godwit::flight {
namespace home_test {

constexpr double metres_of_latitude = 111'200;

TEST(home, is_the_same_within_15_m_and_2_m_of_height) {
  const home_place home{47, 8, 400};
  EXPECT_TRUE(is_same_home(home, home));
  EXPECT_TRUE(is_same_home(home, {47 + 14 / metres_of_latitude, 8, 402}));
  EXPECT_FALSE(is_same_home(home, {47 + 16 / metres_of_latitude, 8, 400}));
  EXPECT_FALSE(is_same_home(home, {47, 8, 403}));
  EXPECT_FALSE(is_same_home(home, {470, 8, 400})) << "a place that is none";
}

TEST(home, of_an_arming_is_as_it_is_told_first_unless_that_lies_elsewhere_than_before) {
  const home_place before{47, 8, 400};
  const home_place near{47 + 10 / metres_of_latitude, 8, 403};
  const home_place elsewhere{47 + 20 / metres_of_latitude, 8, 400};
  EXPECT_EQ(home_of_arming(near, before), near);
  EXPECT_EQ(home_of_arming(elsewhere, before), before);
  EXPECT_EQ(home_of_arming({47, 8, 420}, before), before) << "altitudes count from there";
  EXPECT_EQ(home_of_arming(elsewhere, std::nullopt), elsewhere);
}

} // namespace home_test
} // namespace godwit::flight
