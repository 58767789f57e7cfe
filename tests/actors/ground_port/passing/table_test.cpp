#include "actors/ground_port/passing/table.hpp"

#include <gtest/gtest.h>

#include "actors/ground_port/forward_gate.hpp"
#include "io/mavlink/ids.hpp"

namespace godwit::ground_port::passing {
namespace table_test {

using mavlink::message_list;

TEST(passing_table, nothing_of_the_mission_protocol_passes) {
  transfer_messages::for_each([]<class M>() {
    const auto* const row = find_message(M::message_id);
    ASSERT_NE(row, nullptr) << M::message_id;
    EXPECT_EQ(row->on, pass_list::owned) << M::message_id;
  });
  for (const std::uint16_t each : {17, 188, 189, 192, 193, 224, 300})
    EXPECT_EQ(find_command(each)->on, pass_list::owned) << each;
}

TEST(passing_table, keys_and_what_is_not_known_are_on_no_list) {
  EXPECT_EQ(find_message(256), nullptr);   // SETUP_SIGNING
  EXPECT_EQ(find_message(109), nullptr);   // RADIO_STATUS
  EXPECT_EQ(find_command(2'800), nullptr); // PANORAMA_CREATE
}

TEST(passing_table, what_turns_the_vehicle_is_a_persons) {
  for (const std::uint16_t each : {115, 195, 196, 197, 198, 201})
    EXPECT_EQ(find_command(each)->on, pass_list::person) << each;
}

TEST(passing_table, terrain_traffic_and_tunnels_pass_where_the_settings_name_them) {
  for (const auto* const each : {"TERRAIN_DATA", "ADSB_VEHICLE", "TUNNEL"})
    EXPECT_TRUE(is_for_setting(each)) << each;
}

// A frame of each with a byte of its own at each place.
TEST(passing_table, the_target_is_where_the_message_has_it) {
  message_list<mavlink::param_request_read, mavlink::param_request_list, mavlink::param_set, mavlink::command_long,
               mavlink::command_int, mavlink::mission_count, mavlink::mission_item_int,
               mavlink::mission_request_int>::for_each([]<class M>() {
    M what;
    what.target_system = 7;
    what.target_component = 9;
    const auto frame = mavlink::encode(what, {255, 190}, 0);
    EXPECT_EQ(target_of(*find_message(M::message_id), frame.view()), (mavlink::sender{7, 9})) << M::message_id;
  });
  const auto mode = mavlink::encode(mavlink::set_mode{.target_system = 7, .base_mode = 1}, {255, 190}, 0);
  EXPECT_EQ(target_of(*find_message(11), mode.view()), (mavlink::sender{7, 0}));
}

TEST(passing_table, each_target_lies_in_its_message) {
  for (std::uint32_t id = 0; id < 500; ++id)
    if (const auto* const row = find_message(id); row != nullptr && row->target_at != no_target) {
      ASSERT_NE(mavlink::find_message(id), nullptr) << id;
      EXPECT_LT(row->target_at + (row->names_component ? 1 : 0), int{mavlink::find_message(id)->full_length}) << id;
      EXPECT_EQ(row->name, mavlink::find_message(id)->name) << id;
    }
}

TEST(passing_table, only_what_the_settings_decide_has_a_name_for_them) {
  EXPECT_TRUE(is_for_setting("SERIAL_CONTROL"));
  EXPECT_TRUE(is_for_setting("DO_MOTOR_TEST"));
  EXPECT_FALSE(is_for_setting("PARAM_SET"));
  EXPECT_FALSE(is_for_setting(""));
}

} // namespace table_test
} // namespace godwit::ground_port::passing
