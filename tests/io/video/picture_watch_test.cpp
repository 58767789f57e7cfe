#include "io/video/picture_watch.hpp"

#include <gtest/gtest.h>

#include "tests/io/video/painted_frame.hpp"

namespace picture_watch_test {

using namespace godwit::io::video;

constexpr std::int64_t tenth = 100'000'000;

picture_fault after(picture_watch& watch, int first, int last, std::uint8_t brightness, int step) {
  auto result = picture_fault::none;
  for (int i = first; i <= last; ++i)
    result = watch.look(painted_frame(64, 48, static_cast<std::uint8_t>(brightness + i * step), i * tenth));
  return result;
}

TEST(picture_watch, a_second_of_the_same_picture_is_a_fault_and_another_one_ends_it) {
  picture_watch watch;
  EXPECT_EQ(after(watch, 1, 10, 90, 0), picture_fault::none);
  EXPECT_EQ(after(watch, 11, 11, 90, 0), picture_fault::repeated);
  EXPECT_EQ(after(watch, 12, 12, 91, 0), picture_fault::none);
}

TEST(picture_watch, a_second_of_black_is_a_fault_also_where_it_changes) {
  picture_watch watch;
  EXPECT_EQ(after(watch, 1, 1, 90, 0), picture_fault::none);
  EXPECT_EQ(after(watch, 2, 10, 5, 1), picture_fault::none);
  EXPECT_EQ(after(watch, 11, 11, 5, 1), picture_fault::black);
  EXPECT_EQ(after(watch, 12, 12, 90, 0), picture_fault::none);
}

TEST(picture_watch, pictures_of_any_size_are_taken) {
  picture_watch watch;
  EXPECT_EQ(watch.look(painted_frame(1, 1, 90, 1)), picture_fault::none);
  EXPECT_EQ(watch.look(painted_frame(1280, 720, 90, 2)), picture_fault::none);
}

} // namespace picture_watch_test
