#include "programs/godwit-trace/message_name.hpp"

#include <gtest/gtest.h>

namespace godwit::trace_tool {
namespace message_name_test {

TEST(message_name, ids_of_the_table_have_their_name_and_others_their_number) {
  EXPECT_EQ(message_name(0), "HEARTBEAT");
  EXPECT_EQ(message_name(299), "WIFI_CONFIG_AP");
  EXPECT_EQ(message_name(54'321), "UNKNOWN_54321");
}

TEST(message_name, the_nearest_has_the_fewest_changed_letters) {
  EXPECT_EQ(nearest_message_name("HEARTBAET"), "HEARTBEAT");
  EXPECT_EQ(nearest_message_name("MISION_COUNT"), "MISSION_COUNT");
  EXPECT_EQ(nearest_message_name("COMMAND_ACKK"), "COMMAND_ACK");
}

TEST(message_name, a_name_that_contains_what_was_typed_is_nearer_than_any_other) {
  EXPECT_EQ(nearest_message_name("GPS_RAW"), "GPS_RAW_INT");
  EXPECT_EQ(nearest_message_name("TEXT"), "STATUSTEXT");
}

} // namespace message_name_test
} // namespace godwit::trace_tool
