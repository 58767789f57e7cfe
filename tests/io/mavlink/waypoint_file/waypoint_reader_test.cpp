#include "io/mavlink/waypoint_file/waypoint_reader.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "io/mavlink/waypoint_file/format.hpp"

namespace godwit::io::mavlink {
namespace waypoint_reader_test {

const std::string header = "QGC WPL 110\n";
const std::string item_0 = "0\t1\t3\t16\t0\t5\t0\tNaN\t50.0000000\t36.4000001\t800\t1\n";
const std::string item_1 = "1\t0\t3\t21\t0\t0\t0\t0\t-50.1\t-36.5\t0.25\t1\n";

waypoint_error error_of(const std::string& text) {
  const auto read = read_waypoints(text);
  EXPECT_FALSE(read) << text;
  return read ? waypoint_error{} : read.error();
}

// An item like the first, with COLUMN as TEXT.
std::string with(waypoint_column column, const std::string& text) {
  std::istringstream parts(item_0);
  std::string line;
  std::string part;
  for (std::size_t i = 0; std::getline(parts, part, '\t'); ++i)
    line += (i == 0 ? "" : "\t") + (i == static_cast<std::size_t>(column) ? text : part);
  return header + line + (line.ends_with('\n') ? "" : "\n");
}

void expect_wrong(waypoint_column column, const std::string& text, waypoint_errc code) {
  const auto error = error_of(with(column, text));
  EXPECT_EQ(error.code, code) << text;
  EXPECT_EQ(error.line, 2U) << text;
  EXPECT_EQ(error.column, name_of(column)) << text;
  EXPECT_NE(error.what, "");
}

TEST(waypoint_reader, each_column_becomes_a_field_of_the_item) {
  const auto items = read_waypoints(header + item_0 + item_1, mav_mission_type::rally);
  ASSERT_TRUE(items) << items.error().message();
  ASSERT_EQ(items->size(), 2U);
  const auto& first = items->at(0);
  EXPECT_EQ(first.seq, 0);
  EXPECT_EQ(first.current, 1);
  EXPECT_EQ(first.frame, 3);
  EXPECT_EQ(first.command, 16);
  EXPECT_EQ(first.param1, 0.0F);
  EXPECT_EQ(first.param2, 5.0F);
  EXPECT_TRUE(std::isnan(first.param4));
  EXPECT_EQ(first.x, 500'000'000);
  EXPECT_EQ(first.y, 364'000'001);
  EXPECT_EQ(first.z, 800.0F);
  EXPECT_EQ(first.autocontinue, 1);
  EXPECT_EQ(first.mission_type, 2);
  EXPECT_EQ(first.target_system, 0);
  EXPECT_EQ(items->at(1).seq, 1);
  EXPECT_EQ(items->at(1).x, -501'000'000);
  EXPECT_EQ(items->at(1).z, 0.25F);
}

TEST(waypoint_reader, ends_of_lines_of_other_systems_marks_and_spaces_make_no_difference) {
  const auto plain = read_waypoints(header + item_0);
  ASSERT_TRUE(plain);
  std::string spaces = item_0;
  for (auto& each : spaces)
    each = each == '\t' ? ' ' : each;
  const std::string line = item_0.substr(0, item_0.size() - 1);
  const std::string same[] = {
      "QGC WPL 110\r\n" + line + "\r\n", "\xEF\xBB\xBF" + header + item_0,  header + line, header + "  " + spaces,
      header + item_0 + "\n\r\n \t\n\n", "QGC WPL   110 \n" + line + "\t\n"};
  for (const auto& text : same) {
    const auto read = read_waypoints(text);
    ASSERT_TRUE(read) << read.error().message();
    ASSERT_EQ(read->size(), 1U);
    EXPECT_EQ(read->front().y, plain->front().y);
  }
}

TEST(waypoint_reader, a_file_without_items_is_a_plan_of_none) {
  const auto items = read_waypoints("QGC WPL 110");
  ASSERT_TRUE(items);
  EXPECT_TRUE(items->empty());
}

TEST(waypoint_reader, what_is_not_a_plan_is_told_from_an_other_version) {
  EXPECT_EQ(error_of("").message(), "it is empty; the header \"QGC WPL 110\" was expected");
  EXPECT_EQ(error_of("# a note\n \n").message(),
            "nothing is in it but blank lines and comments; the header \"QGC WPL 110\" was expected");
  EXPECT_TRUE(read_waypoints("# a note\n\n" + header));
  EXPECT_EQ(error_of("hello\n").message(), "line 1: \"hello\" where the header \"QGC WPL 110\" was expected");
  EXPECT_NE(error_of("{\n  \"fileType\": \"Plan\"}").message().find(".plan of QGroundControl"), std::string::npos);
  for (const char* each : {"QGC WPL 130\n", "QGC WPL\n", "QGC WPL110\n", "QGC WPL 110 x\n"})
    EXPECT_EQ(error_of(each).code, waypoint_errc::other_version) << each;
}

TEST(waypoint_reader, an_error_names_line_and_column) {
  const std::string text = header + item_0 + "1\t0\t3\t16\t0\t0\t0\t0\t95\t36\t10\t1\n";
  EXPECT_EQ(error_of(text).message(), "line 3, x/lat: \"95\" is not from -90 to 90 degrees");
}

TEST(waypoint_reader, each_column_is_held_to_its_kind_of_number) {
  using enum waypoint_column;
  for (const auto each : {current, frame, command, autocontinue})
    for (const char* text : {"x", "-1", "1.5", ".0", "1.", "+1", "1e0", "0x1"})
      expect_wrong(each, text, waypoint_errc::not_a_number);
  for (const auto each : {param1, param2, param3, param4, z}) {
    for (const char* text : {"x", "inf", "-inf", "nan(1)", "-nan", "1,5", "+1", "0x1p3"})
      expect_wrong(each, text, waypoint_errc::not_a_number);
    expect_wrong(each, "1e39", waypoint_errc::out_of_range);
    EXPECT_TRUE(read_waypoints(with(each, "nan"))) << name_of(each);
    EXPECT_TRUE(read_waypoints(with(each, "-1.5e3"))) << name_of(each);
  }
  for (const auto each : {x, y})
    expect_wrong(each, "NaN", waypoint_errc::not_a_number);
}

TEST(waypoint_reader, numbers_that_can_not_be_there_are_refused) {
  using enum waypoint_column;
  expect_wrong(index, "65536", waypoint_errc::out_of_range);
  expect_wrong(current, "2", waypoint_errc::out_of_range);
  expect_wrong(frame, "256", waypoint_errc::out_of_range);
  expect_wrong(command, "65536", waypoint_errc::out_of_range);
  expect_wrong(command, "99999999999999999999", waypoint_errc::out_of_range);
  expect_wrong(autocontinue, "2", waypoint_errc::out_of_range);
  expect_wrong(frame, "13", waypoint_errc::unknown_frame);
  expect_wrong(y, "-180.5", waypoint_errc::out_of_range);
  EXPECT_TRUE(read_waypoints(with(frame, "1"))) << "metres, and no place on earth";
}

TEST(waypoint_reader, items_are_numbered_as_they_stand_whatever_their_indexes_are) {
  for (const auto* index : {"1", "4", "0"}) {
    const auto items = read_waypoints(header + item_0 + index + item_1.substr(1));
    ASSERT_TRUE(items) << items.error().message();
    ASSERT_EQ(items->size(), 2U);
    EXPECT_EQ(items->at(0).seq, 0);
    EXPECT_EQ(items->at(1).seq, 1);
  }
  EXPECT_EQ(read_waypoints(header + item_1)->front().seq, 0) << "counted from 1";
  expect_wrong(waypoint_column::index, "-1", waypoint_errc::not_a_number);
}

TEST(waypoint_reader, a_jump_needs_indexes_that_count_from_0) {
  const std::string jump = "\t0\t2\t177\t1\t3\t0\t0\t0\t0\t0\t1\n";
  EXPECT_TRUE(read_waypoints(header + item_0 + item_1 + "2" + jump));
  EXPECT_EQ(error_of(header + item_0 + "# one is missing here\n2" + item_1.substr(1) + "3" + jump).message(),
            "line 4, index: \"2\" where 1 was expected, and a DO_JUMP of this plan names items by their index");
}

TEST(waypoint_reader, comments_and_blank_lines_may_stand_anywhere) {
  const auto plain = read_waypoints(header + item_0 + item_1);
  const auto items = read_waypoints("# a square\n\n" + header + "\n# home\n" + item_0 + " \t\n  # back\n" +
                                    item_1.substr(0, item_1.size() - 1) + "\t# church\n\n# end");
  ASSERT_TRUE(items) << items.error().message();
  ASSERT_EQ(items->size(), 2U);
  EXPECT_EQ(items->at(1).x, plain->at(1).x);
  EXPECT_EQ(items->at(1).autocontinue, 1);
}

TEST(waypoint_reader, version_120_has_the_form_of_110) {
  const auto items = read_waypoints("QGC WPL 120\n" + item_0 + item_1);
  ASSERT_TRUE(items) << items.error().message();
  EXPECT_EQ(items->at(1).command, 21);
}

// As pymavlink reads it.
TEST(waypoint_reader, version_100_has_columns_and_actions_of_its_own) {
  const std::string line = "0\t3\t25\t30\t1\t5\t2\t1\t8.5\t47.25\t40\t0\t1\n";
  const auto items = read_waypoints("QGC WPL 100\n" + line);
  ASSERT_TRUE(items) << items.error().message();
  ASSERT_EQ(items->size(), 1U);
  const auto& only = items->front();
  EXPECT_EQ(only.command, 16);
  EXPECT_EQ(only.frame, 3);
  EXPECT_EQ(only.current, 1);
  EXPECT_EQ(only.param1, 5);
  EXPECT_EQ(only.param2, 2);
  EXPECT_EQ(only.param3, 30);
  EXPECT_EQ(only.param4, 1);
  EXPECT_EQ(only.x, 472'500'000);
  EXPECT_EQ(only.y, 85'000'000);
  EXPECT_EQ(only.z, 40);
  EXPECT_EQ(only.autocontinue, 1);
  EXPECT_EQ(error_of("QGC WPL 100\n0\t3\t16\t30\t1\t5\t2\t1\t8.5\t47.25\t40\t0\t1\n").message(),
            "line 2, command: \"16\" is no action of version 100");
  EXPECT_EQ(error_of("QGC WPL 100\n" + item_0).message(),
            "line 2: 12 columns; an item has 13, parted by tabs or spaces");
}

TEST(waypoint_reader, a_whole_number_may_have_a_decimal_point) {
  const auto items = read_waypoints(header + "0.0\t1.0\t3.000\t16.0\t0\t5\t0\tNaN\t50\t36\t800\t1.0\n");
  ASSERT_TRUE(items) << items.error().message();
  EXPECT_EQ(items->front().command, 16);
  EXPECT_EQ(items->front().frame, 3);
}

TEST(waypoint_reader, each_item_knows_its_line) {
  const auto plan = read_plan_lines("# square\n" + header + item_0 + "\n" + item_1);
  ASSERT_TRUE(plan) << plan.error().message();
  EXPECT_EQ(plan->lines, (std::vector<std::size_t>{3, 5}));
}

TEST(waypoint_reader, a_line_has_twelve_columns) {
  EXPECT_EQ(error_of(header + "0\t1\n").message(), "line 2: 2 columns; an item has 12, parted by tabs or spaces");
  EXPECT_EQ(error_of(header + item_0.substr(0, item_0.size() - 1) + "\t7\n").message(),
            "line 2: more than 12 columns; an item has 12, parted by tabs or spaces");
}

TEST(waypoint_reader, blank_lines_are_bounded) {
  EXPECT_EQ(error_of(header + std::string(max_waypoint_blank_lines + 1, '\n')).code, waypoint_errc::too_large);
  EXPECT_TRUE(read_waypoints(header + std::string(max_waypoint_blank_lines, '\n')));
}

TEST(waypoint_reader, lines_and_plans_have_a_longest) {
  const auto error = error_of(header + item_0.substr(0, item_0.size() - 1) + std::string(max_waypoint_line_bytes, ' '));
  EXPECT_EQ(error.code, waypoint_errc::too_large);
  EXPECT_EQ(error.line, 2U);
  std::string text = header;
  for (std::size_t i = 0; i < max_waypoint_items; ++i)
    text += std::to_string(i) + item_1.substr(1);
  const auto items = read_waypoints(text);
  ASSERT_TRUE(items) << items.error().message();
  EXPECT_EQ(items->size(), max_waypoint_items);
  EXPECT_EQ(error_of(text + "65535" + item_1.substr(1)).message(), "line 65537: more than 65535 items");
}

TEST(waypoint_reader, a_plan_as_mission_planner_writes_it_is_read) {
  std::ifstream in(std::string(GODWIT_TEST_DATA) + "/fuzz/waypoint_file/mission_planner", std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  const auto items = read_waypoints(text.str());
  ASSERT_TRUE(items) << items.error().message();
  ASSERT_EQ(items->size(), 5U);
  EXPECT_EQ(items->at(1).command, 22);
  EXPECT_EQ(items->at(2).x, -353'618'312);
  EXPECT_EQ(items->at(2).y, 1'491'651'373);
}

} // namespace waypoint_reader_test
} // namespace godwit::io::mavlink
