#include "io/mqtt/encoder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/mqtt_bytes.hpp"

namespace godwit::io::mqtt {
namespace encoder_test {

namespace bytes = tests::mqtt;

std::shared_ptr<const std::string> payload(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

message will_of(std::string text = R"({"state":"offline"})") {
  return {"gw/v1/rover-7/status", payload(std::move(text)), true, true, 0};
}

bytes::raw_packet only_packet(std::string sent) {
  auto all = bytes::packets_in(sent);
  EXPECT_EQ(all.size(), 1U);
  EXPECT_TRUE(sent.empty());
  return all.empty() ? bytes::raw_packet{} : all.front();
}

TEST(mqtt_encoder, a_connect_is_a_clean_start_of_version_5_with_a_will_and_a_bound_for_what_comes_in) {
  const std::string_view password = "secret";
  const auto sent = encode_connect({"rover-7", "anna", password, 15, 4096}, will_of());
  ASSERT_TRUE(sent) << sent.error();
  const auto packet = only_packet(*sent);
  EXPECT_EQ(packet.type, bytes::connect_type);
  EXPECT_EQ(packet.flags, 0);
  const auto read = bytes::read_connect(packet);
  EXPECT_EQ(read.protocol, "MQTT");
  EXPECT_EQ(read.version, 5);
  EXPECT_EQ(read.flags, 0x80 | 0x40 | 0x20 | 0x08 | 0x04 | 0x02) << "user, password, will retained with QoS 1, clean";
  EXPECT_EQ(read.keep_alive_s, 15);
  EXPECT_EQ(read.properties, (bytes::property_map{{0x27, "4096"}}));
  EXPECT_EQ(read.client_id, "rover-7");
  EXPECT_EQ(read.will_topic, "gw/v1/rover-7/status");
  EXPECT_EQ(read.will, R"({"state":"offline"})");
  EXPECT_EQ(read.will_properties, (bytes::property_map{{0x03, "application/json"}}));
  EXPECT_EQ(read.user, "anna");
  EXPECT_EQ(read.password, "secret");
}

TEST(mqtt_encoder, without_a_user_there_is_none_and_no_password) {
  auto will = will_of();
  will.is_retained = false;
  const auto read = bytes::read_connect(only_packet(*encode_connect({"rover-7", "", {}, 15, 4096}, will)));
  EXPECT_EQ(read.flags, 0x08 | 0x04 | 0x02);
  EXPECT_FALSE(read.user || read.password);
}

TEST(mqtt_encoder, a_connect_takes_no_more_room_than_it_has_so_that_no_copy_of_a_password_stays) {
  const std::string password(4096, 'p');
  const auto sent = encode_connect({"rover-7", "anna", std::string_view(password), 15, 4096}, will_of());
  EXPECT_EQ(sent->capacity(), sent->size());
}

TEST(mqtt_encoder, what_no_packet_can_hold_is_refused_by_a_sentence) {
  const std::string long_text(65'536, 'a');
  for (const auto& id : {long_text, std::string("a\0b", 3), std::string("\xC3")})
    EXPECT_FALSE(encode_connect({id, "", {}, 15, 4096}, will_of()));
  EXPECT_FALSE(encode_connect({"a", long_text, {}, 15, 4096}, will_of()));
  EXPECT_FALSE(encode_connect({"a", "b", std::string_view(long_text), 15, 4096}, will_of()));
  EXPECT_FALSE(encode_connect({"a", "", {}, 15, 4096}, will_of(long_text)));
  EXPECT_FALSE(encode_publish({"", payload("{}"), false, false, 0}, 0));
  EXPECT_FALSE(encode_publish({"a\xFF", payload("{}"), false, false, 0}, 0));
  EXPECT_FALSE(encode_publish({"a", payload(std::string(max_sent_bytes + 1, ' ')), false, false, 0}, 0));
}

TEST(mqtt_encoder, a_ping_and_a_disconnect_are_as_the_standard_has_them) {
  EXPECT_EQ(encode_ping(), std::string("\xC0\x00", 2));
  EXPECT_EQ(encode_disconnect(reason_code::disconnect_with_will), "\xE0\x01\x04");
}

RC_GTEST_PROP(mqtt_encoder_property, a_message_is_read_as_it_was_sent_and_no_longer_than_is_said, ()) {
  const auto topic = *rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::inRange<char>('a', 'z')));
  const auto size = *rc::gen::element<std::size_t>(0, 1, 90, 127, 128, 16'000, 16'384, 70'000, 300'000);
  const auto text = std::string(size, *rc::gen::inRange<char>(' ', '~'));
  const bool is_acknowledged = *rc::gen::arbitrary<bool>();
  const bool is_retained = *rc::gen::arbitrary<bool>();
  const auto expires_s = *rc::gen::arbitrary<std::uint32_t>();
  const auto id = is_acknowledged ? *rc::gen::inRange(1, 65'536) : 0;
  auto sent =
      encode_publish({topic, payload(text), is_acknowledged, is_retained, expires_s}, static_cast<std::uint16_t>(id));
  RC_ASSERT(sent.has_value());
  RC_ASSERT(sent->size() <= publish_bytes(topic.size(), text.size()));
  const auto all = bytes::packets_in(*sent);
  RC_ASSERT(all.size() == 1U && sent->empty() && all.front().type == bytes::publish_type);
  const auto read = bytes::read_publish(all.front());
  RC_ASSERT(read.topic == topic && read.payload == text && read.is_retained == is_retained && read.id == id);
  RC_ASSERT(read.qos == (is_acknowledged ? 1 : 0));
  auto properties = bytes::property_map{{0x03, "application/json"}};
  if (expires_s != 0)
    properties[0x02] = std::to_string(expires_s);
  RC_ASSERT(read.properties == properties);
}

} // namespace encoder_test
} // namespace godwit::io::mqtt
