#include "io/mqtt/encoder.hpp"

#include <cassert>

#include "io/mqtt/cursor.hpp"

namespace godwit::io::mqtt {
namespace {

constexpr char connect_packet = '\x10';
constexpr std::uint8_t publish_packet = 0x30;
constexpr char ping_packet = '\xC0';
constexpr char disconnect_packet = '\xE0';

constexpr std::uint8_t clean_start = 0x02;
constexpr std::uint8_t has_will = 0x04;
constexpr std::uint8_t will_with_qos_1 = 0x08;
constexpr std::uint8_t will_is_retained = 0x20;
constexpr std::uint8_t has_password = 0x40;
constexpr std::uint8_t has_user = 0x80;
constexpr std::uint8_t publish_with_qos_1 = 0x02;
constexpr std::uint8_t publish_is_retained = 0x01;
constexpr char protocol_version = 5;

// Of properties.
constexpr char message_expiry = 0x02;
constexpr char content_type = 0x03;
constexpr char maximum_packet_size = 0x27;
constexpr std::string_view json_type = "application/json";

constexpr std::size_t max_text_bytes = 65'535;
constexpr std::size_t largest_one_byte_length = 127;

void add_number(std::string& to, std::uint32_t value, unsigned bytes) {
  for (auto left = bytes; left-- > 0;)
    to += static_cast<char>(value >> 8U * left & 0xFFU);
}

void add_length(std::string& to, std::size_t value) {
  do {
    const auto low = static_cast<std::uint8_t>(value & 0x7FU);
    value >>= 7U;
    to += static_cast<char>(value != 0 ? low | 0x80U : low);
  } while (value != 0);
}

std::size_t length_bytes(std::size_t value) {
  std::size_t result = 1;
  while ((value >>= 7U) != 0)
    ++result;
  return result;
}

void add_text(std::string& to, std::string_view text) {
  add_number(to, static_cast<std::uint32_t>(text.size()), 2);
  to += text;
}

std::size_t text_bytes(std::string_view text) { return 2 + text.size(); }

// With their length before them, which is below 128 for all that we send.
std::string message_properties(std::uint32_t expires_s) {
  std::string result(1, '\0');
  result += content_type;
  add_text(result, json_type);
  if (expires_s != 0) {
    result += message_expiry;
    add_number(result, expires_s, 4);
  }
  assert(result.size() - 1 <= largest_one_byte_length);
  result.front() = static_cast<char>(result.size() - 1);
  return result;
}

constexpr std::size_t max_property_bytes = 1 + 1 + 2 + json_type.size() + 1 + 4;

tl::unexpected<std::string> no_text(std::string_view what) {
  return tl::make_unexpected(std::string(what) +
                             " is no text of MQTT: it has more than 65,535 bytes, is no UTF-8, or holds a zero");
}

bool fits(std::string_view text) { return text.size() <= max_text_bytes && is_mqtt_text(text); }

tl::unexpected<std::string> too_long(std::string_view what, std::size_t bytes) {
  return tl::make_unexpected(std::string(what) + " has " + std::to_string(bytes) + " bytes, and may have " +
                             std::to_string(max_sent_bytes));
}

encoded checked(const connect_request& what, const message& will) {
  if (!fits(what.client_id))
    return no_text("the client id");
  if (!fits(what.username))
    return no_text("the user");
  if (what.password && what.password->size() > max_text_bytes)
    return tl::make_unexpected("the password has more than 65,535 bytes");
  if (!fits(will.topic))
    return no_text("the topic of the will");
  if (will.payload->size() > max_text_bytes)
    return tl::make_unexpected("the will has more than 65,535 bytes");
  return {};
}

std::uint8_t connect_flags(const connect_request& what, const message& will) {
  unsigned result = clean_start | has_will | will_with_qos_1;
  if (will.is_retained)
    result |= will_is_retained;
  if (!what.username.empty())
    result |= has_user;
  if (what.password)
    result |= has_password;
  return static_cast<std::uint8_t>(result);
}

} // namespace

encoded encode_connect(const connect_request& what, const message& will) {
  if (auto objection = checked(what, will); !objection)
    return objection;
  std::string head;
  add_text(head, "MQTT");
  head += protocol_version;
  head += static_cast<char>(connect_flags(what, will));
  add_number(head, what.keep_alive_s, 2);
  head += '\x05'; // of properties
  head += maximum_packet_size;
  add_number(head, what.max_packet_bytes, 4);
  const auto about_will = message_properties(0);
  auto length =
      head.size() + text_bytes(what.client_id) + about_will.size() + text_bytes(will.topic) + text_bytes(*will.payload);
  length += what.username.empty() ? 0 : text_bytes(what.username);
  length += what.password ? text_bytes(*what.password) : 0;

  std::string result;
  result.reserve(1 + length_bytes(length) + length);
  result += connect_packet;
  add_length(result, length);
  result += head;
  add_text(result, what.client_id);
  result += about_will;
  add_text(result, will.topic);
  add_text(result, *will.payload);
  if (!what.username.empty())
    add_text(result, what.username);
  if (what.password)
    add_text(result, *what.password);
  assert(result.size() == 1 + length_bytes(length) + length);
  return result;
}

encoded encode_publish(const message& what, std::uint16_t packet_id) {
  assert(what.is_acknowledged == (packet_id != 0));
  if (!fits(what.topic) || what.topic.empty())
    return no_text("the topic of a message");
  const auto about = message_properties(what.expires_s);
  const auto length = text_bytes(what.topic) + (packet_id != 0 ? 2 : 0) + about.size() + what.payload->size();
  if (length > max_sent_bytes)
    return too_long("a message", length);
  std::string result;
  result.reserve(1 + length_bytes(length) + length);
  result += static_cast<char>(publish_packet | (what.is_acknowledged ? publish_with_qos_1 : 0U) |
                              (what.is_retained ? publish_is_retained : 0U));
  add_length(result, length);
  add_text(result, what.topic);
  if (packet_id != 0)
    add_number(result, packet_id, 2);
  result += about;
  result += *what.payload;
  return result;
}

std::size_t publish_bytes(std::size_t topic_bytes, std::size_t payload_bytes) {
  const auto length = 2 + topic_bytes + 2 + max_property_bytes + payload_bytes;
  return 1 + length_bytes(length) + length;
}

std::string encode_ping() { return {ping_packet, '\0'}; }

std::string encode_disconnect(reason_code why) { return {disconnect_packet, '\x01', static_cast<char>(why)}; }

} // namespace godwit::io::mqtt
