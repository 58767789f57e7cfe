#include "io/mqtt/decoder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/mqtt/cursor.hpp"
#include "tests/support/mqtt_bytes.hpp"

namespace godwit::io::mqtt {
namespace decoder_test {

namespace bytes = tests::mqtt;
using bytes::connack;
using bytes::number;
using bytes::property;
using bytes::text;

tl::expected<std::optional<packet>, violation> read_one(std::string_view sent) {
  packet_reader reader;
  return reader.read(sent);
}

std::string refusal_of(const std::string& sent) {
  const auto read = read_one(sent);
  return read ? std::string(*read ? "taken" : "not whole") : read.error().sentence;
}

TEST(mqtt_decoder, the_limits_of_a_broker_are_read_from_its_connack) {
  const auto read =
      read_one(connack(0, property(0x21, number(20, 2)) + property(0x24, number(1, 1)) + property(0x25, number(0, 1)) +
                              property(0x27, number(65'536, 4)) + property(0x13, number(60, 2)) +
                              property(0x22, number(10, 2)) + property(0x26, text("a") + text("b")) +
                              property(0x26, text("a") + text("c")) + property(0x1F, text("fine"))));
  ASSERT_TRUE(read && *read);
  const auto& known = std::get<io::mqtt::connack>(**read);
  EXPECT_TRUE(known.is_mqtt_5);
  EXPECT_EQ(known.reason, reason_code::success);
  EXPECT_EQ(known.receive_maximum, 20);
  EXPECT_EQ(known.maximum_qos, 1);
  EXPECT_FALSE(known.retain_available);
  EXPECT_EQ(known.maximum_packet_bytes, 65'536U);
  EXPECT_EQ(known.server_keep_alive_s, 60);
}

TEST(mqtt_decoder, what_mosquitto_sends_is_taken) {
  // As 2.0.11 has sent it to this publisher: tests/data/mqtt/README.md.
  for (const auto& sent :
       {std::string("\x20\x09\x00\x00\x06\x22\x00\x0a\x21\x00\x14", 11),
        std::string("\x20\x13\x00\x00\x10\x22\x00\x0a\x13\x00\x0a\x25\x00\x27\x00\x00\x07\xd0\x21\x00\x07", 21),
        std::string("\x20\x05\x00\x9b\x02\x24\x00", 7), std::string("\x20\x03\x00\x9a\x00", 5),
        std::string("\x40\x03\x00\x01\x10", 5), std::string("\x40\x03\x00\x01\x87", 5), std::string("\xd0\x00", 2),
        std::string("\xe0\x01\x9a", 3)}) {
    const auto read = read_one(sent);
    EXPECT_TRUE(read && *read) << (read ? "not whole" : read.error().sentence);
  }
}

TEST(mqtt_decoder, an_older_broker_is_understood_as_one_that_says_no) {
  const auto read = read_one(std::string("\x20\x02\x00\x01", 4));
  ASSERT_TRUE(read && *read);
  EXPECT_FALSE(std::get<io::mqtt::connack>(**read).is_mqtt_5);
}

TEST(mqtt_decoder, every_packet_but_four_is_refused_at_its_first_byte) {
  for (int type = 0; type < 16; ++type) {
    const bool is_known = type == 2 || type == 4 || type == 13 || type == 14;
    EXPECT_EQ(read_one(number(static_cast<std::uint64_t>(type * 16), 1)).has_value(), is_known) << type;
    for (int flags = 1; flags < 16; ++flags)
      EXPECT_FALSE(read_one(number(static_cast<std::uint64_t>(type * 16 + flags), 1))) << type << ' ' << flags;
  }
  EXPECT_EQ(refusal_of("\x30"), "sends PUBLISH, which nobody has asked for");
}

TEST(mqtt_decoder, what_is_longer_than_4_KiB_is_refused_at_its_length_and_nothing_of_it_is_kept) {
  EXPECT_EQ(refusal_of("\x20\xff\xff\xff\x7f"), "sends CONNACK that is longer than 4096 bytes") << "256 MB";
  EXPECT_EQ(refusal_of("\x20\xff\xff"), "sends CONNACK that is longer than 4096 bytes");
  EXPECT_EQ(refusal_of(bytes::number(0x20, 1) + bytes::varint(max_packet_bytes - 2)),
            "sends CONNACK that is longer than 4096 bytes");
  EXPECT_EQ(refusal_of(bytes::number(0x20, 1) + bytes::varint(max_packet_bytes - 3)), "not whole");
  EXPECT_EQ(refusal_of("\xd0\x01"), "sends PINGRESP that is longer than 2 bytes");
  packet_reader reader;
  std::string sent = number(0x20, 1) + bytes::varint(max_packet_bytes - 3) + std::string(5'000, '\0');
  std::string_view rest = sent;
  (void)reader.read(rest);
  EXPECT_LE(reader.held_bytes(), max_packet_bytes);
}

TEST(mqtt_decoder, the_packet_that_ended_godwitd_is_refused) {
  EXPECT_EQ(refusal_of(std::string("\x20\x05\x00\x00\x01\x7a\x00", 7)),
            "sends CONNACK with properties whose length is wrong");
  EXPECT_EQ(refusal_of(connack(0, property(0x7a, number(0, 1)))),
            "sends CONNACK with a property that is unknown or does not belong there (0x7a)");
  EXPECT_NE(refusal_of(bytes::disconnect(0x80, property(0x7a, number(0, 1)))).find("(0x7a)"), std::string::npos);
  EXPECT_NE(refusal_of(bytes::puback(1, 0, property(0x7a, number(0, 1)))).find("(0x7a)"), std::string::npos);
}

TEST(mqtt_decoder, a_property_that_stands_twice_does_not_belong_there_or_has_a_value_that_is_none_is_refused) {
  for (const auto& properties :
       {property(0x21, number(20, 2)) + property(0x21, number(20, 2)), property(0x21, number(0, 2)),
        property(0x24, number(2, 1)), property(0x25, number(2, 1)), property(0x27, number(0, 4)),
        property(0x12, text("another id")), property(0x15, text("SCRAM")), property(0x1A, text("topic")),
        property(0x03, text("application/json")), property(0x1F, text("\xC0\x80")),
        property(0x1F, number(9, 2) + "abc"), property(0x26, text("a")), property(0x13, number(1, 1))})
    EXPECT_FALSE(read_one(connack(0, properties)));
  EXPECT_FALSE(read_one(bytes::puback(7, 0, property(0x21, number(20, 2)))));
  EXPECT_FALSE(read_one(bytes::disconnect(0, property(0x11, number(20, 4))))) << "a broker must not";
  EXPECT_FALSE(read_one(connack(0, {}, 1))) << "a session that was not asked for";
  EXPECT_FALSE(read_one(bytes::puback(0)));
  EXPECT_FALSE(read_one(bytes::puback(1, 0x01)));
  EXPECT_FALSE(read_one(std::string("\x40\x82\x00\x00\x01", 5))) << "a length in more bytes than it needs";
}

TEST(mqtt_decoder, after_a_violation_nothing_is_read_any_more) {
  packet_reader reader;
  const std::string sent = "\x30" + connack();
  std::string_view rest = sent;
  EXPECT_FALSE(reader.read(rest));
  EXPECT_FALSE(reader.read(rest));
  EXPECT_EQ(rest.size(), sent.size() - 1);
}

TEST(mqtt_utf8, a_text_is_well_formed_and_holds_no_zero) {
  for (const std::string_view good : {"", "rover-7", "\xC3\xA4", "\xE2\x82\xAC", "\xF0\x9F\x9A\x81", "\xEF\xBF\xBF"})
    EXPECT_TRUE(is_mqtt_text(good)) << good;
  for (const std::string_view bad :
       {std::string_view("\0", 1), std::string_view("\x80"), std::string_view("\xC3"), std::string_view("\xC0\x80"),
        std::string_view("\xED\xA0\x80"), std::string_view("\xF4\x90\x80\x80"), std::string_view("\xFF"),
        std::string_view("\xE2\x82"), std::string_view("\xE0\x80\x80")})
    EXPECT_FALSE(is_mqtt_text(bad));
}

RC_GTEST_PROP(mqtt_decoder_property, packets_are_the_same_however_they_come_in_pieces, ()) {
  std::string sent = connack(0, property(0x21, number(20, 2)));
  const auto ids = *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 65'536));
  for (const auto id : ids)
    sent += id % 3 == 0 ? bytes::pingresp() : bytes::puback(id);
  packet_reader reader;
  std::size_t packets = 0;
  for (std::string_view left = sent; !left.empty();) {
    auto piece = left.substr(0, *rc::gen::inRange<std::size_t>(1, 9));
    left.remove_prefix(piece.size());
    for (auto next = reader.read(piece); next && *next; next = reader.read(piece))
      ++packets;
    RC_ASSERT(piece.empty());
  }
  RC_ASSERT(packets == ids.size() + 1);
}

} // namespace decoder_test
} // namespace godwit::io::mqtt
