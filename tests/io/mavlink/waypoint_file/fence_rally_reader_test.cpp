#include "io/mavlink/waypoint_file/fence_rally_reader.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"

namespace godwit::io::mavlink {
namespace fence_rally_reader_test {

// Made for this test, in the form of MAVProxy's.
const std::string fence = "47.3980\t8.5460\n"
                          "47.3970\t8.5450\n"
                          "47.3990\t8.5450\n"
                          "47.3990 8.5470\n"
                          "47.3970 8.5470\n"
                          "47.3970\t8.5450\n";
const std::string rally = "RALLY 47.3980\t8.5460\t60.5\t40.0\t0.0\t0\n";

TEST(fence_rally_reader, a_fence_is_a_point_of_return_and_the_corners_of_one_polygon_to_stay_inside_of) {
  EXPECT_EQ(fence_or_rally(fence), mav_mission_type::fence);
  const auto read = read_fence_lines(fence);
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_EQ(read->items.size(), 5U) << "the corner that closes the ring is not one more";
  EXPECT_EQ(read->items[0].command, number(mav_cmd::nav_fence_return_point));
  EXPECT_EQ(read->items[0].x, 473'980'000);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_EQ(read->items[i].command, number(mav_cmd::nav_fence_polygon_vertex_inclusion));
    EXPECT_EQ(read->items[i].param1, 4);
    EXPECT_EQ(read->items[i].seq, i);
    EXPECT_EQ(read->items[i].mission_type, number(mav_mission_type::fence));
  }
  EXPECT_EQ(read->lines, (std::vector<std::size_t>{1, 2, 3, 4, 5}));
}

TEST(fence_rally_reader, marks_comments_blank_lines_and_other_ends_of_lines_make_no_difference) {
  std::string windows = "\xEF\xBB\xBF# a field\r\n\r\n";
  for (const auto each : fence)
    windows += each == '\n' ? std::string("  # corner\r\n") : std::string(1, each);
  EXPECT_EQ(fence_or_rally(windows), mav_mission_type::fence);
  const auto read = read_fence_lines(windows);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->items.size(), 5U);
  EXPECT_EQ(read->lines.front(), 3U);
}

TEST(fence_rally_reader, a_ring_may_be_open) {
  const auto read = read_fence_lines("0 0\n1 1\n1 2\n2 2\n");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->items.size(), 4U);
}

TEST(fence_rally_reader, a_rally_point_has_a_place_and_a_height_above_home) {
  EXPECT_EQ(fence_or_rally(rally), mav_mission_type::rally);
  const auto read = read_rally_lines(rally + rally);
  ASSERT_TRUE(read) << read.error().message();
  ASSERT_EQ(read->items.size(), 2U);
  EXPECT_EQ(read->items[1].command, number(mav_cmd::nav_rally_point));
  EXPECT_EQ(read->items[1].frame, number(mav_frame::global_relative_alt));
  EXPECT_EQ(read->items[1].z, 60.5F);
  EXPECT_EQ(read->items[1].seq, 1);
}

TEST(fence_rally_reader, what_is_wrong_names_the_line) {
  EXPECT_EQ(read_fence_lines("0 0\n1 1\n95 2\n2 2\n").error().message(),
            "line 3, latitude: \"95\" is not from -90 to 90 degrees");
  EXPECT_EQ(read_fence_lines("0 0\n1 1 1\n").error().message(),
            "line 2: a line of a fence is a latitude and a longitude");
  EXPECT_EQ(read_fence_lines("0 0\n1 1\n1 2\n1 1\n").error().message(),
            "a fence is a point of return and a polygon of at least 3 corners; it has 2 corners");
  EXPECT_EQ(read_rally_lines(rally + "RALLY 1 2\n").error().line, 2U);
  EXPECT_EQ(read_rally_lines("RALLY 1 2 x 0 0 0\n").error().message(), "line 1, altitude: \"x\" is not a number");
}

TEST(fence_rally_reader, other_texts_are_neither) {
  for (const auto* text : {"", "# nothing\n", "QGC WPL 110\n", "{}", "1 2 3\n", "a b\n", "nan 1\n"})
    EXPECT_EQ(fence_or_rally(text), std::nullopt) << text;
}

} // namespace fence_rally_reader_test
} // namespace godwit::io::mavlink
