#include "programs/godwit-trace/name_filter.hpp"

#include <gtest/gtest.h>

namespace godwit::trace_tool {
namespace name_filter_test {

name_filter filter_of(const std::vector<std::string>& lists) {
  auto filter = name_filter::parse(lists);
  EXPECT_TRUE(filter) << filter.error();
  return filter ? *filter : name_filter();
}

std::string error_of(const std::string& list) {
  const auto filter = name_filter::parse(std::vector{list});
  return filter ? "" : filter.error();
}

TEST(name_filter, a_star_stands_for_any_letters) {
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("MISSION_*", "MISSION_ACK"));
  EXPECT_TRUE(matches("*_INT*", "MISSION_ITEM_INT"));
  EXPECT_TRUE(matches("A*B*C", "AxBxBxC"));
  EXPECT_TRUE(matches("A**", "A"));
  EXPECT_FALSE(matches("MISSION", "MISSION_ACK"));
  EXPECT_FALSE(matches("*_INT", "MISSION_ITEM_INTO"));
  EXPECT_FALSE(matches("A*B", "A"));
  EXPECT_FALSE(matches("", "A"));
}

TEST(name_filter, none_given_wants_all) {
  EXPECT_TRUE(name_filter().wants(0));
  EXPECT_TRUE(filter_of({}).wants(54'321));
}

TEST(name_filter, lists_add_up_and_capitals_make_no_difference) {
  const auto filter = filter_of({"heartbeat, Mission_*", "STATUSTEXT"});
  EXPECT_TRUE(filter.wants(0));
  EXPECT_TRUE(filter.wants(47));
  EXPECT_TRUE(filter.wants(253));
  EXPECT_FALSE(filter.wants(30));
  EXPECT_FALSE(filter.wants(54'321));
}

TEST(name_filter, ids_of_no_table_go_by_their_number) {
  EXPECT_TRUE(filter_of({"UNKNOWN_54321"}).wants(54'321));
  EXPECT_FALSE(filter_of({"UNKNOWN_54321"}).wants(54'322));
  EXPECT_TRUE(filter_of({"unknown_*"}).wants(54'322));
  EXPECT_FALSE(filter_of({"unknown_*"}).wants(0));
  EXPECT_TRUE(filter_of({"*"}).wants(54'322));
  EXPECT_TRUE(filter_of({"*"}).wants(0));
}

TEST(name_filter, a_name_that_is_none_is_answered_with_the_nearest) {
  EXPECT_EQ(error_of("heartbaet"), "no message is called \"HEARTBAET\"; the nearest is HEARTBEAT");
  EXPECT_EQ(error_of("HEARTBEAT,,PING"), "a name of a message is empty");
  EXPECT_EQ(error_of("XYZ*"), "no name of a message matches \"XYZ*\"");
  EXPECT_NE(error_of("UNKNOWN_"), "");
  EXPECT_NE(error_of("UNKNOWN_12x"), "");
}

} // namespace name_filter_test
} // namespace godwit::trace_tool
