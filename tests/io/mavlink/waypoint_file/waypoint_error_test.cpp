#include "io/mavlink/waypoint_file/waypoint_error.hpp"

#include <gtest/gtest.h>

namespace godwit::io::mavlink {
namespace waypoint_error_test {

TEST(waypoint_error, the_sentence_names_file_line_and_column_as_far_as_there_are_any) {
  waypoint_error error{waypoint_errc::out_of_range, "survey.waypoints", 5, "x/lat", "\"95\" is not a latitude"};
  EXPECT_EQ(error.message(), "survey.waypoints: line 5, x/lat: \"95\" is not a latitude");
  error.column.clear();
  EXPECT_EQ(error.message(), "survey.waypoints: line 5: \"95\" is not a latitude");
  error.line = 0;
  EXPECT_EQ(error.message(), "survey.waypoints: \"95\" is not a latitude");
  error.file.clear();
  EXPECT_EQ(error.message(), "\"95\" is not a latitude");
}

TEST(waypoint_error, text_of_others_is_quoted_short_and_plain) {
  EXPECT_EQ(in_quotes("a\x1b[31m\tb"), "\"a?[31m?b\"");
  EXPECT_EQ(in_quotes(std::string(41, 'x')), "\"" + std::string(40, 'x') + "...\"");
}

} // namespace waypoint_error_test
} // namespace godwit::io::mavlink
