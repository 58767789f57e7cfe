#include "actors/domain/geofence/fence_name.hpp"

#include <gtest/gtest.h>

namespace godwit::geofence {
namespace fence_name_test {

TEST(fence_name, people_count_from_one) {
  EXPECT_EQ(fence_name(0), "geofence 1");
  EXPECT_EQ(fence_name(99), "geofence 100");
}

} // namespace fence_name_test
} // namespace godwit::geofence
