#include "io/mavlink/waypoint_file/coordinate_text.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::io::mavlink {
namespace coordinate_text_test {

std::string written(coordinate_kind kind, axis which, std::int32_t value) {
  std::string out;
  const auto result = append_coordinate(out, kind, which, value);
  return result ? out : result.error().what;
}

TEST(coordinate_text, frames_say_what_x_and_y_are) {
  for (const int each : {0, 3, 5, 6, 10, 11})
    EXPECT_EQ(coordinates_of(static_cast<std::uint8_t>(each)), coordinate_kind::global) << each;
  for (const int each : {1, 4, 7, 8, 9, 12, 20, 21})
    EXPECT_EQ(coordinates_of(static_cast<std::uint8_t>(each)), coordinate_kind::local) << each;
  EXPECT_EQ(coordinates_of(2), coordinate_kind::none);
  for (const int each : {13, 19, 22, 255})
    EXPECT_EQ(coordinates_of(static_cast<std::uint8_t>(each)), std::nullopt) << each;
}

TEST(coordinate_text, integers_are_written_with_all_their_decimals) {
  EXPECT_EQ(written(coordinate_kind::global, axis::x, 500'000'001), "50.0000001");
  EXPECT_EQ(written(coordinate_kind::global, axis::x, -1), "-0.0000001");
  EXPECT_EQ(written(coordinate_kind::global, axis::y, -1'800'000'000), "-180.0000000");
  EXPECT_EQ(written(coordinate_kind::local, axis::x, -25'000), "-2.5000");
  EXPECT_EQ(written(coordinate_kind::local, axis::y, std::numeric_limits<std::int32_t>::min()), "-214748.3648");
  EXPECT_EQ(written(coordinate_kind::none, axis::x, 42), "42");
  EXPECT_EQ(written(coordinate_kind::global, axis::x, 900'000'001), "90.0000001 is not from -90 to 90 degrees");
}

TEST(coordinate_text, decimals_beyond_the_last_are_rounded_to_the_nearest) {
  EXPECT_EQ(read_coordinate(coordinate_kind::global, axis::x, "47.39774251"), 473'977'425);
  EXPECT_EQ(read_coordinate(coordinate_kind::global, axis::x, "47.39774258"), 473'977'426);
  EXPECT_EQ(read_coordinate(coordinate_kind::global, axis::x, "-47.39774258"), -473'977'426);
  EXPECT_EQ(read_coordinate(coordinate_kind::global, axis::x, "90.00000004"), 900'000'000);
}

TEST(coordinate_text, a_position_that_is_not_on_earth_is_refused) {
  for (const char* each : {"90.0000001", "-91", "1e300", "-1e300"})
    EXPECT_EQ(read_coordinate(coordinate_kind::global, axis::x, each).error().code, waypoint_errc::out_of_range)
        << each;
  EXPECT_TRUE(read_coordinate(coordinate_kind::global, axis::y, "91"));
  EXPECT_EQ(read_coordinate(coordinate_kind::global, axis::y, "180.1").error().code, waypoint_errc::out_of_range);
}

TEST(coordinate_text, what_does_not_fit_into_the_integer_is_refused) {
  EXPECT_EQ(read_coordinate(coordinate_kind::local, axis::x, "214748.3647"), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(read_coordinate(coordinate_kind::local, axis::x, "-214748.3648"), std::numeric_limits<std::int32_t>::min());
  for (const char* each : {"214748.3648", "-214748.3649", "1e300"})
    EXPECT_EQ(read_coordinate(coordinate_kind::local, axis::x, each).error().code, waypoint_errc::out_of_range) << each;
}

TEST(coordinate_text, without_a_position_only_whole_numbers_can_be_sent) {
  EXPECT_EQ(read_coordinate(coordinate_kind::none, axis::x, "2.00000000"), 2);
  EXPECT_EQ(read_coordinate(coordinate_kind::none, axis::y, "-7"), -7);
  EXPECT_EQ(read_coordinate(coordinate_kind::none, axis::x, "0.5").error().code, waypoint_errc::not_a_number);
}

TEST(coordinate_text, what_is_not_a_number_is_refused) {
  for (const char* each : {"", "north", "1.5x", "nan", "inf", "-", "1,5", "0x10"})
    EXPECT_EQ(read_coordinate(coordinate_kind::global, axis::x, each).error().code, waypoint_errc::not_a_number)
        << each;
}

RC_GTEST_PROP(coordinate_text, every_integer_reads_back_as_itself, (std::int32_t value)) {
  for (const auto kind : {coordinate_kind::global, coordinate_kind::local, coordinate_kind::none}) {
    std::string out;
    if (append_coordinate(out, kind, axis::y, value)) {
      RC_ASSERT(read_coordinate(kind, axis::y, out) == value);
    } else {
      RC_ASSERT(kind == coordinate_kind::global);
    }
  }
}

} // namespace coordinate_text_test
} // namespace godwit::io::mavlink
