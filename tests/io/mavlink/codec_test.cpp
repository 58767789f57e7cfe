#include <gtest/gtest.h>

#include <limits>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/enums.hpp"
#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink {
namespace codec_test {

constexpr sender station{255, 190};
constexpr sender vehicle{1, 1};

// The same bytes as other implementations make and the same values from them; made with the generator of the MAVLink
// project.
template <message M>
void expect_golden(std::string_view hex, const M& value, sender from, std::uint8_t sequence) {
  EXPECT_EQ(to_hex(encode(value, from, sequence).span()), hex) << type_name<M>();
  const auto found = frames_in(from_hex(hex));
  ASSERT_EQ(found.size(), 1U) << type_name<M>();
  const frame_view frame(found.front().data());
  EXPECT_EQ(frame.id(), M::message_id);
  EXPECT_EQ(frame.from(), from);
  EXPECT_EQ(frame.sequence(), sequence);
  EXPECT_TRUE(equal(decode<M>(frame), value)) << type_name<M>();
}

command_long order(mav_cmd command, float param1) {
  return {.target_system = 1, .target_component = 1, .command = number(command), .param1 = param1};
}

statustext text_message(std::string_view text) {
  statustext result{.severity = number(mav_severity::info)};
  text.copy(result.text.data(), result.text.size());
  return result;
}

TEST(codec, golden_frames_of_a_station_are_equal_in_both_directions) {
  expect_golden("fd09000000ffbe000000000000001208000403211a", heartbeat{.type = 18, .autopilot = 8, .system_status = 4},
                station, 0);
  expect_golden("fd20000001ffbe4c0000000000000000000000000000000000000000000000000000000000002c010101d375",
                order(mav_cmd::mission_start, 0), station, 1);
  expect_golden("fd20000002ffbe4c00000000803f0000000000000000000000000000000000000000000000009001010142db",
                order(mav_cmd::component_arm_disarm, 1), station, 2);
  expect_golden("fd20000003ffbe4c000000000000000000000000000000000000000000000000000000000000140001014572",
                order(mav_cmd::nav_return_to_launch, 0), station, 3);
  expect_golden("fd04000004ffbe2c0000030001015212",
                mission_count{.target_system = 1, .target_component = 1, .count = 3}, station, 4);
  expect_golden("fd25000005ffbe490000000000000000a04000000000000000000065cd1d0033b21500004844000010000101030001dada",
                mission_item_int{.target_system = 1,
                                 .target_component = 1,
                                 .frame = 3,
                                 .command = 16,
                                 .autocontinue = 1,
                                 .param2 = 5,
                                 .x = 500000000,
                                 .y = 364000000,
                                 .z = 800},
                station, 5);
  expect_golden("fd0200000affbe2d0000010108c5", mission_clear_all{.target_system = 1, .target_component = 1}, station,
                10);
}

TEST(codec, golden_frames_of_a_transfer_are_equal_in_both_directions) {
  expect_golden("fd0400000601013300000000ffbe7cb0", mission_request_int{.target_system = 255, .target_component = 190},
                vehicle, 6);
  expect_golden("fd0800000701012f0000ffbe0000efbeaddef01a",
                mission_ack{.target_system = 255, .target_component = 190, .opaque_id = 0xDEADBEEF}, vehicle, 7);
  expect_golden("fd0a00000801012a0000020003000301efbeadde8420",
                mission_current{.seq = 2, .total = 3, .mission_state = 3, .mission_mode = 1, .mission_id = 0xDEADBEEF},
                vehicle, 8);
  expect_golden("fd0100000901012e0000016534", mission_item_reached{.seq = 1}, vehicle, 9);
  expect_golden("fd0a00000b01014d00002c01000000000000ffbe2800",
                command_ack{.command = 300, .target_system = 255, .target_component = 190}, vehicle, 11);
}

TEST(codec, golden_frames_of_telemetry_are_equal_in_both_directions) {
  expect_golden("fd1000000c0101fd0000064d697373696f6e2073746172746564504a", text_message("Mission started"), vehicle,
                12);
  expect_golden("fd1f00000d01010100000000000000000000000000000000603bffff000000000000000000000000184b4f",
                sys_status{.voltage_battery = 15200, .current_battery = -1, .battery_remaining = 24}, vehicle, 13);
  expect_golden("fd1c00000e0101210000e80300000065cd1d0033b215a0bb0d0000350c006400ceff00002823ae0f",
                global_position_int{1000, 500000000, 364000000, 900000, 800000, 100, -50, 0, 9000}, vehicle, 14);
  expect_golden("fd0200000f0101f5000000013e7f", extended_sys_state{.landed_state = 1}, vehicle, 15);
}

TEST(codec, cuts_zeros_off_but_never_the_first_byte) {
  EXPECT_EQ(to_hex(encode(ping{}, station, 16).span()), "fd01000010ffbe040000004c9a");
  const auto found = frames_in(from_hex("fd01000010ffbe040000004c9a"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(equal(decode<ping>(frame_view(found.front().data())), ping{}));
}

TEST(codec, takes_a_payload_without_any_byte) {
  const frame_buffer frame(ping::message_id, ping::crc_extra, {}, vehicle, 0, false);
  EXPECT_EQ(frame.size(), min_frame_size);
  EXPECT_EQ(frames_in(frame.span()).size(), 1U);
  EXPECT_TRUE(equal(decode<ping>(frame.view()), ping{}));
  EXPECT_TRUE(equal(decode_payload<ping>({}), ping{})); // of a list without memory
}

TEST(codec, takes_zeros_that_were_not_cut_off_and_a_surplus_of_newer_fields) {
  const auto whole = from_hex("0100000000000000020000000304");
  const ping expected{1, 2, 3, 4};
  EXPECT_TRUE(equal(decode_payload<ping>(whole), expected));
  auto longer = whole;
  append(longer, from_hex("ffffffff"));
  EXPECT_TRUE(equal(decode_payload<ping>(longer), expected));
  auto untrimmed = from_hex("0100000000000000020000000000");
  EXPECT_TRUE(equal(decode_payload<ping>(untrimmed), ping{1, 2, 0, 0}));
}

TEST(codec, a_payload_cut_off_inside_a_field_is_filled_up_with_zeros) {
  EXPECT_EQ(decode_payload<ping>(from_hex("0102")).time_usec, 0x0201U);
  EXPECT_EQ(decode_payload<mission_item_reached>(from_hex("05")).seq, 5);
}

TEST(codec, keeps_the_bits_of_numbers_that_are_none) {
  attitude said{.roll = std::numeric_limits<float>::quiet_NaN(), .pitch = -std::numeric_limits<float>::infinity()};
  said.yaw = -0.0F;
  EXPECT_EQ(bits_of(decode<attitude>(encode(said, vehicle, 0).view())), bits_of(said));
}

} // namespace codec_test
} // namespace godwit::io::mavlink
