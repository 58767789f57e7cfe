#include <gtest/gtest.h>

#include "io/mavlink/layout.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"

namespace godwit::io::mavlink {
namespace layout_test {

template <message M>
std::size_t offset_of(std::string_view name) {
  std::size_t result = SIZE_MAX;
  for_each_placed_field<M>([&](const auto& entry, auto offset) {
    if (entry.name == name)
      result = offset;
  });
  return result;
}

TEST(layout, sorts_by_size_and_keeps_the_order_of_the_table_among_equals) {
  EXPECT_EQ(offset_of<heartbeat>("custom_mode"), 0U);
  EXPECT_EQ(offset_of<heartbeat>("type"), 4U);
  EXPECT_EQ(offset_of<heartbeat>("mavlink_version"), 8U);
  EXPECT_EQ(offset_of<command_int>("x"), 16U);
  EXPECT_EQ(offset_of<command_int>("command"), 28U);
  EXPECT_EQ(offset_of<command_int>("autocontinue"), 34U);
  EXPECT_EQ(offset_of<autopilot_version>("uid"), 8U);
  EXPECT_EQ(offset_of<autopilot_version>("os_custom_version"), 52U);
}

TEST(layout, sorts_arrays_by_the_size_of_one_element) {
  EXPECT_EQ(offset_of<battery_status>("voltages"), 10U);
  EXPECT_EQ(offset_of<battery_status>("current_battery"), 30U);
  EXPECT_EQ(offset_of<statustext>("text"), 1U);
  EXPECT_EQ(offset_of<home_position>("q"), 24U);
}

TEST(layout, puts_extensions_at_the_end_unsorted) {
  EXPECT_EQ(offset_of<battery_status>("time_remaining"), 36U);
  EXPECT_EQ(offset_of<battery_status>("voltages_ext"), 41U);
  EXPECT_EQ(offset_of<battery_status>("fault_bitmask"), 50U);
  EXPECT_EQ(offset_of<mission_count>("opaque_id"), 5U);
  EXPECT_EQ(offset_of<mission_ack>("opaque_id"), 4U);
  EXPECT_EQ(offset_of<mission_current>("mission_id"), 6U);
  EXPECT_EQ(offset_of<command_ack>("target_component"), 9U);
  EXPECT_EQ(offset_of<gps_raw_int>("yaw"), 50U);
  EXPECT_EQ(offset_of<statustext>("chunk_seq"), 53U);
  EXPECT_EQ(offset_of<home_position>("time_usec"), 52U);
}

struct misnamed {
  std::uint16_t sequence = 0; // published as `seq`
  static constexpr std::uint32_t message_id = 46;
  static constexpr std::uint8_t crc_extra = 11;
  static constexpr auto fields = table("MISSION_ITEM_REACHED", field("sequence", &misnamed::sequence));
};

TEST(layout, of_a_table_with_a_wrong_name_is_not_the_published_one) {
  EXPECT_TRUE(as_published<mission_item_reached>(2, 2));
  EXPECT_FALSE(as_published<misnamed>(2, 2));
}

TEST(layout, reads_what_it_wrote) {
  request_data_stream asked{.target_system = 1, .target_component = 2, .req_stream_id = 3, .req_message_rate = 0x1234};
  std::array<std::byte, layout<request_data_stream>::full_length> wire{};
  write_fields(asked, wire.data());
  EXPECT_EQ(wire[0], std::byte{0x34});
  EXPECT_EQ(wire[1], std::byte{0x12});
  EXPECT_TRUE(equal(read_fields<request_data_stream>(wire.data()), asked));
}

} // namespace layout_test
} // namespace godwit::io::mavlink
