#include "programs/godwitd/sightings/point_pictures.hpp"

#include <gtest/gtest.h>

namespace point_pictures_test {

using namespace godwit;
using daemon::point_pictures;

io::eyes::cutout taken_at(std::int64_t captured_ns) { return {1, captured_ns, 48, 48, {std::byte{0xFF}}}; }

TEST(point_pictures, a_point_has_the_newest_picture_of_its_sightings) {
  point_pictures all;
  EXPECT_FALSE(all.of(1));
  all.add("a", taken_at(100));
  all.add("b", taken_at(300));
  all.add("c", taken_at(200));
  EXPECT_FALSE(all.of(1)) << "nobody knows yet of which point it is";
  for (const auto* each : {"a", "b", "c", "of a file, without a picture"})
    all.belongs(each, 1);
  ASSERT_TRUE(all.of(1));
  EXPECT_EQ(all.of(1)->captured_ns, 300);
  EXPECT_FALSE(all.of(2));
  EXPECT_EQ(all.points(), std::vector<std::uint64_t>{1}) << "of others nobody needs to ask";
}

TEST(point_pictures, of_sightings_that_wait_and_of_points_the_oldest_go) {
  point_pictures all;
  for (std::size_t n = 0; n <= point_pictures::max_waiting; ++n)
    all.add(std::to_string(n), taken_at(100));
  all.belongs("0", 1);
  all.belongs("1", 2);
  EXPECT_FALSE(all.of(1));
  EXPECT_TRUE(all.of(2));
  for (std::uint64_t point = 3; point <= point_pictures::max_points + 2; ++point) {
    all.add("more", taken_at(100));
    all.belongs("more", point);
  }
  EXPECT_FALSE(all.of(2));
  EXPECT_TRUE(all.of(3));
  EXPECT_TRUE(all.of(point_pictures::max_points + 2));
}

} // namespace point_pictures_test
