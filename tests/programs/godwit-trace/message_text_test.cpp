#include "programs/godwit-trace/message_text.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace message_text_test {

using namespace io::mavlink;

std::string text_of(const frame_buffer& frame) {
  std::string out;
  append_message_text(out, frame.view());
  return out;
}

std::string statustext_of(std::string_view text) {
  statustext message{.severity = 6};
  std::ranges::copy(text, message.text.begin());
  return text_of(frame_of(message));
}

TEST(message_text, fields_stand_in_the_order_of_the_table_with_the_names_of_enums) {
  EXPECT_EQ(text_of(frame_of(command_ack{.command = 400, .target_system = 255, .target_component = 190})),
            "COMMAND_ACK          command=400(COMPONENT_ARM_DISARM) result=0(ACCEPTED) progress=0 result_param2=0 "
            "target_system=255 target_component=190");
  EXPECT_EQ(text_of(frame_of(heartbeat{.type = 2, .autopilot = 12, .base_mode = 128, .system_status = 4})),
            "HEARTBEAT            type=2(QUADROTOR) autopilot=12(PX4) base_mode=128(SAFETY_ARMED) custom_mode=0 "
            "system_status=4(ACTIVE) mavlink_version=3");
}

TEST(message_text, floats_have_as_many_digits_as_it_takes) {
  const attitude message{.time_boot_ms = 7,
                         .roll = 0.1F,
                         .pitch = std::numeric_limits<float>::quiet_NaN(),
                         .yaw = -std::numeric_limits<float>::infinity(),
                         .yawspeed = -2.5F};
  EXPECT_EQ(text_of(frame_of(message)),
            "ATTITUDE             time_boot_ms=7 roll=0.1 pitch=NaN yaw=-inf rollspeed=0 pitchspeed=0 yawspeed=-2.5");
  EXPECT_NE(text_of(frame_of(command_long{.param2 = 200'000})).find("param2=200000 "), std::string::npos);
}

TEST(message_text, bytes_are_hexadecimal_and_other_arrays_are_lists) {
  EXPECT_EQ(text_of(frame_of(protocol_version{.version = 200, .spec_version_hash = {1, 2, 0xFF}})),
            "PROTOCOL_VERSION     version=200 min_version=0 max_version=0 spec_version_hash=0102ff0000000000 "
            "library_version_hash=0000000000000000");
  EXPECT_NE(text_of(frame_of(battery_status{.voltages_ext = {1, 2, 3, 65'535}})).find(" voltages_ext=[1,2,3,65535] "),
            std::string::npos);
}

TEST(message_text, text_can_not_command_a_terminal) {
  EXPECT_EQ(statustext_of("a\x1b[31m\"b\"\n"),
            "STATUSTEXT           severity=6(INFO) text=\"a\\u001b[31m\\\"b\\\"\\n\" id=0 chunk_seq=0");
  EXPECT_NE(statustext_of("del\x7f!").find("\"del?!\""), std::string::npos);
  EXPECT_NE(statustext_of("csi\xC2\x9B!").find("\"csi?!\""), std::string::npos);
  EXPECT_NE(statustext_of("\xC3\xBC\xC2\xB0").find("\"\xC3\xBC\xC2\xB0\""), std::string::npos) << "letters stay";
}

TEST(message_text, what_is_not_decoded_is_shown_by_its_first_bytes) {
  EXPECT_EQ(text_of(raw_frame(31, {1, 2, 0xAB})), "ATTITUDE_QUATERNION  3 bytes: 0102ab");
  EXPECT_EQ(text_of(raw_frame(54'321, {9})), "UNKNOWN_54321        1 byte: 09");
  EXPECT_EQ(text_of(raw_frame(331, std::vector<std::uint8_t>(17, 0x11))),
            "ODOMETRY             17 bytes: 11111111111111111111111111111111...");
}

TEST(message_text, a_longer_name_pushes_its_line_to_the_right) {
  EXPECT_EQ(text_of(raw_frame(85, {1})), "POSITION_TARGET_LOCAL_NED 1 byte: 01");
}

TEST(message_text, secrets_are_never_shown) {
  setup_signing message{.target_system = 1, .target_component = 1, .initial_timestamp = 5};
  message.secret_key.fill(0x77);
  EXPECT_EQ(text_of(frame_of(message)),
            "SETUP_SIGNING        target_system=1 target_component=1 secret_key=(withheld) initial_timestamp=5");
  for (const std::uint32_t id : {5U, 7U, 299U, 336U}) {
    const auto text = text_of(raw_frame(id, std::vector<std::uint8_t>(28, 0x77)));
    EXPECT_EQ(text.find("77"), std::string::npos) << text;
    EXPECT_NE(text.find("28 bytes (withheld)"), std::string::npos) << text;
  }
}

} // namespace message_text_test
} // namespace godwit::trace_tool::test
