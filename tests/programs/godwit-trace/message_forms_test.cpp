#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/mavlink/messages.hpp"
#include "programs/godwit-trace/message_forms.hpp"
#include "tests/programs/godwit-trace/tool_fixture.hpp"

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

namespace godwit::trace_tool {

namespace enum_fields_test {

std::string name_in(std::uint32_t message_id, std::string_view field, std::uint64_t value) {
  const auto rows = enum_fields_of(message_id);
  const auto found = std::ranges::find(rows, field, &enum_field::field);
  std::string out;
  if (found != rows.end())
    found->append_name(out, value);
  return out;
}

TEST(enum_fields, every_row_names_an_unsigned_field_of_its_message) {
  std::size_t found = 0;
  io::mavlink::known_messages::for_each([&]<io::mavlink::message M>() {
    io::for_each_field<M>([&](const auto& entry) {
      using value = std::remove_cvref_t<decltype(M{}.*entry.member)>;
      for (const auto& row : enum_fields_of(M::message_id))
        found += row.field == entry.name && std::is_unsigned_v<value> ? 1 : 0;
    });
  });
  EXPECT_EQ(found, enum_fields().size());
}

TEST(enum_fields, numbers_have_the_names_of_mavlink) {
  EXPECT_EQ(name_in(77, "result", 0), "ACCEPTED");
  EXPECT_EQ(name_in(77, "command", 400), "COMPONENT_ARM_DISARM");
  EXPECT_EQ(name_in(47, "type", 13), "INVALID_SEQUENCE");
  EXPECT_EQ(name_in(253, "severity", 4), "WARNING");
  EXPECT_EQ(name_in(0, "autopilot", 12), "PX4");
  EXPECT_EQ(name_in(44, "mission_type", 255), "ALL");
}

TEST(enum_fields, bits_have_all_their_names) {
  EXPECT_EQ(name_in(0, "base_mode", 129), "CUSTOM_MODE_ENABLED|SAFETY_ARMED");
  EXPECT_EQ(name_in(0, "base_mode", 0), "");
}

TEST(enum_fields, what_has_no_name_gets_none) {
  EXPECT_EQ(name_in(77, "command", 65'000), "");
  EXPECT_EQ(name_in(77, "result", 256), "") << "not the name of 0";
  EXPECT_EQ(name_in(77, "progress", 0), "");
  EXPECT_TRUE(enum_fields_of(30).empty());
}

} // namespace enum_fields_test

} // namespace godwit::trace_tool

namespace godwit::trace_tool::test {

namespace message_json_test {

using namespace io::mavlink;
using nlohmann::json;

std::string text_of(const frame_view& frame) {
  std::string out;
  append_message_json(out, some_day_us, frame);
  return out;
}

json json_of(const frame_buffer& frame) { return json::parse(text_of(frame.view())); }

TEST(message_json, a_line_has_head_and_fields) {
  EXPECT_EQ(
      text_of(frame_of(mission_item_reached{.seq = 3}, 9).view()),
      R"({"time_us":1781000000123456,"system":1,"component":1,"sequence":9,"id":46,"name":"MISSION_ITEM_REACHED",)"
      R"("signed":false,"fields":{"seq":3}})");
}

TEST(message_json, nan_is_null) {
  const auto line = json_of(frame_of(attitude{.roll = std::numeric_limits<float>::quiet_NaN(), .pitch = 0.5F}));
  EXPECT_TRUE(line.at("fields").at("roll").is_null());
  EXPECT_EQ(line.at("fields").at("pitch"), 0.5);
}

TEST(message_json, what_is_not_decoded_has_its_bytes_in_place_of_fields) {
  const auto line = json_of(raw_frame(54'321, {0, 0xAB}));
  EXPECT_EQ(line.at("name"), "UNKNOWN_54321");
  EXPECT_EQ(line.at("payload"), "00ab");
  EXPECT_FALSE(line.contains("fields"));
}

TEST(message_json, secrets_are_left_out) {
  setup_signing message;
  message.secret_key.fill(0x77);
  EXPECT_FALSE(json_of(frame_of(message)).at("fields").contains("secret_key"));
  EXPECT_FALSE(json_of(raw_frame(7, {0x77})).contains("payload"));
}

TEST(message_json, signed_frames_say_so) {
  signer key(counting_key(), link_id{1}, signing_time{0});
  auto frame = encode(heartbeat{}, {1, 1}, 0, signing::on);
  ASSERT_TRUE(key.sign(frame, static_cast<std::int64_t>(some_day_us) * 1'000));
  EXPECT_EQ(json_of(frame).at("signed"), true);
}

TEST(message_json, all_of_our_messages_parse_with_all_their_open_fields) {
  const auto seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  known_messages::for_each([&]<message M>() {
    std::array<std::byte, layout<M>::full_length> payload{};
    for (auto& each : payload)
      each = static_cast<std::byte>(random());
    const auto line = json_of(frame_of(decode_payload<M>(payload)));
    EXPECT_EQ(line.at("name"), M::fields.type_name);
    io::for_each_field<M>(
        [&](const auto& entry) { EXPECT_EQ(line.at("fields").contains(entry.name), !entry.is_secret) << entry.name; });
  });
}

} // namespace message_json_test

} // namespace godwit::trace_tool::test
