#include "programs/godwit-trace/message_json.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/programs/godwit-trace/tool_fixture.hpp"

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
