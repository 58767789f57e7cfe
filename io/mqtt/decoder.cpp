#include "io/mqtt/decoder.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "io/mqtt/cursor.hpp"

namespace godwit::io::mqtt {

namespace {

constexpr std::array<std::string_view, 16> packet_names{
    "packet type 0", "CONNECT", "CONNACK",     "PUBLISH",  "PUBACK",  "PUBREC",   "PUBREL",     "PUBCOMP",
    "SUBSCRIBE",     "SUBACK",  "UNSUBSCRIBE", "UNSUBACK", "PINGREQ", "PINGRESP", "DISCONNECT", "AUTH"};

constexpr unsigned connack_type = 2;
constexpr unsigned puback_type = 4;
constexpr unsigned pingresp_type = 13;
constexpr unsigned disconnect_type = 14;

using read_result = tl::expected<std::optional<packet>, violation>;

unsigned type_of(std::uint8_t first) { return first >> 4U; }

tl::unexpected<violation> wrong(std::string_view which, const std::string& what,
                                reason_code answer = reason_code::malformed_packet) {
  return tl::make_unexpected(violation{answer, "sends " + std::string(which) + " with " + what});
}

void use_in(connack& to, property which, std::uint32_t value) {
  switch (which) {
  case property::receive_maximum:
    to.receive_maximum = static_cast<std::uint16_t>(value);
    break;
  case property::maximum_qos:
    to.maximum_qos = static_cast<std::uint8_t>(value);
    break;
  case property::retain_available:
    to.retain_available = value != 0;
    break;
  case property::maximum_packet_size:
    to.maximum_packet_bytes = value;
    break;
  case property::server_keep_alive:
    to.server_keep_alive_s = static_cast<std::uint16_t>(value);
    break;
  default:
    break; // nothing that a publisher needs
  }
}

// Version 3 has no properties: two bytes, the answer 1 to 5; some answer so with a reason of version 5.
bool is_of_version_3(std::string_view body) { return body.size() == 2 && body[1] != '\0'; }

read_result connack_of(std::string_view body) {
  connack to;
  if (is_of_version_3(body)) {
    to.is_mqtt_5 = false;
    to.reason = reason_code::unsupported_protocol;
    return packet(to);
  }
  cursor at(body);
  const auto flags = at.number(1);
  to.reason = static_cast<reason_code>(at.number(1));
  if (flags != 0)
    return wrong("CONNACK", "a session that nobody has asked for", reason_code::protocol_error);
  if (to.reason != reason_code::success && !is_refusal(to.reason))
    return wrong("CONNACK", name_of(to.reason), reason_code::protocol_error);
  if (const auto objection = read_properties(body.substr(2), in_connack,
                                             [&](property which, std::uint32_t value) { use_in(to, which, value); }))
    return wrong("CONNACK", *objection);
  return packet(to);
}

// The reason, and the properties, may both be left out from the end. AT stands before the reason.
tl::expected<reason_code, violation> reason_of(std::string_view which, std::string_view rest, property_place place) {
  if (rest.empty())
    return reason_code::success;
  const auto reason = static_cast<reason_code>(rest.front());
  if (rest.size() > 1)
    if (const auto objection = read_properties(rest.substr(1), place, [](property, std::uint32_t) {}))
      return wrong(which, *objection);
  return reason;
}

read_result puback_of(std::string_view body) {
  cursor at(body);
  const auto id = static_cast<std::uint16_t>(at.number(2));
  if (id == 0)
    return wrong("PUBACK", "the number 0", reason_code::protocol_error);
  const auto reason = reason_of("PUBACK", body.substr(2), in_puback);
  if (!reason)
    return tl::make_unexpected(reason.error());
  if (*reason != reason_code::success && *reason != reason_code::no_matching_subscribers && !is_refusal(*reason))
    return wrong("PUBACK", name_of(*reason), reason_code::protocol_error);
  return packet(puback{id, *reason});
}

read_result disconnect_of(std::string_view body) {
  const auto reason = reason_of("DISCONNECT", body, in_disconnect);
  if (!reason)
    return tl::make_unexpected(reason.error());
  return packet(disconnect{*reason});
}

read_result packet_of(std::uint8_t first, std::string_view body) {
  switch (type_of(first)) {
  case connack_type:
    return connack_of(body);
  case puback_type:
    return puback_of(body);
  case disconnect_type:
    return disconnect_of(body);
  default:
    return packet(pingresp{});
  }
}

struct lengths {
  std::size_t least;
  std::size_t most;
};

lengths lengths_of(unsigned type) {
  constexpr std::size_t most = max_packet_bytes - 3; // first byte and two of length
  switch (type) {
  case connack_type:
  case puback_type:
    return {2, most};
  case disconnect_type:
    return {0, most};
  default:
    return {0, 0};
  }
}

} // namespace

packet_reader::checked packet_reader::take_first(std::uint8_t byte) {
  const auto type = type_of(byte);
  if (type != connack_type && type != puback_type && type != pingresp_type && type != disconnect_type)
    return violation{reason_code::protocol_error,
                     "sends " + std::string(packet_names[type]) + ", which nobody has asked for"};
  if ((byte & 0x0FU) != 0)
    return violation{reason_code::malformed_packet,
                     "sends " + std::string(packet_names[type]) + " with flags that do not belong there"};
  first_ = byte;
  step_ = step::length;
  length_ = 0;
  length_bytes_ = 0;
  return {};
}

packet_reader::checked packet_reader::take_length(std::uint8_t byte) {
  const auto type = type_of(first_);
  length_ |= static_cast<std::size_t>(byte & 0x7FU) << 7U * length_bytes_++;
  const bool has_more = (byte & 0x80U) != 0;
  const auto [least, most] = lengths_of(type);
  if ((has_more && length_bytes_ == 2) || length_ > most)
    return violation{reason_code::packet_too_large,
                     "sends " + std::string(packet_names[type]) + " that is longer than " +
                         (most == 0 ? "2" : std::to_string(max_packet_bytes)) + " bytes"};
  if (has_more)
    return {};
  if (length_ < least || (length_bytes_ == 2 && byte == 0))
    return violation{reason_code::malformed_packet,
                     "sends " + std::string(packet_names[type]) + " with a length that is wrong"};
  step_ = step::body;
  return {};
}

tl::expected<std::optional<packet>, violation> packet_reader::read(std::string_view& bytes) {
  while (!broken_) {
    if (step_ == step::body) {
      const auto size = std::min(length_ - body_.size(), bytes.size());
      body_ += bytes.substr(0, size);
      bytes.remove_prefix(size);
      if (body_.size() < length_)
        return std::nullopt;
      step_ = step::first_byte;
      auto whole = packet_of(first_, body_);
      body_.clear();
      if (!whole)
        broken_ = whole.error();
      return whole;
    }
    if (bytes.empty())
      return std::nullopt;
    const auto byte = static_cast<std::uint8_t>(bytes.front());
    bytes.remove_prefix(1);
    broken_ = step_ == step::first_byte ? take_first(byte) : take_length(byte);
  }
  return tl::make_unexpected(*broken_);
}

namespace {

enum class form { byte, two_bytes, four_bytes, text, two_texts };

struct row {
  property which;
  std::string_view name;
  form how;
  unsigned places;
  std::uint32_t least; // of a number
  std::uint32_t most;
};

constexpr auto any = std::numeric_limits<std::uint32_t>::max();
constexpr unsigned everywhere = in_connack | in_puback | in_disconnect;

// What is not here must not be there: that of other packets, and what answers a question that we never ask (an assigned
// client id, authentication, response information).
constexpr std::array<row, 13> rows{{
    {property::session_expiry_interval, "Session Expiry Interval", form::four_bytes, in_connack, 0, any},
    {property::server_keep_alive, "Server Keep Alive", form::two_bytes, in_connack, 0, any},
    {property::server_reference, "Server Reference", form::text, in_connack | in_disconnect, 0, 0},
    {property::reason_string, "Reason String", form::text, everywhere, 0, 0},
    {property::receive_maximum, "Receive Maximum", form::two_bytes, in_connack, 1, any},
    {property::topic_alias_maximum, "Topic Alias Maximum", form::two_bytes, in_connack, 0, any},
    {property::maximum_qos, "Maximum QoS", form::byte, in_connack, 0, 1},
    {property::retain_available, "Retain Available", form::byte, in_connack, 0, 1},
    {property::user_property, "User Property", form::two_texts, everywhere, 0, 0},
    {property::maximum_packet_size, "Maximum Packet Size", form::four_bytes, in_connack, 1, any},
    {property::wildcard_subscription_available, "Wildcard Subscription Available", form::byte, in_connack, 0, 1},
    {property::subscription_identifiers_available, "Subscription Identifiers Available", form::byte, in_connack, 0, 1},
    {property::shared_subscription_available, "Shared Subscription Available", form::byte, in_connack, 0, 1},
}};

std::string hexadecimal(std::uint32_t byte) {
  constexpr std::string_view digits = "0123456789abcdef";
  return std::string("0x") + digits[byte >> 4U & 0xFU] + digits[byte & 0xFU];
}

// Of a text: 0.
std::uint32_t value_of(form how, cursor& at) {
  switch (how) {
  case form::byte:
    return at.number(1);
  case form::two_bytes:
    return at.number(2);
  case form::four_bytes:
    return at.number(4);
  case form::two_texts:
    at.skip_text();
    at.skip_text();
    return 0;
  case form::text:
    at.skip_text();
    return 0;
  }
  return 0;
}

} // namespace

std::optional<std::string> read_properties(std::string_view bytes, property_place place,
                                           const std::function<void(property, std::uint32_t)>& use) {
  cursor at(bytes);
  const auto length = at.length();
  if (!at.is_sound() || length != at.left())
    return "properties whose length is wrong";
  std::uint64_t seen = 0; // a bit for each number: all are below 64
  while (!at.is_at_end()) {
    const auto number = at.number(1);
    const auto* const found =
        std::ranges::find_if(rows, [&](const row& each) { return static_cast<std::uint32_t>(each.which) == number; });
    if (found == rows.end() || (found->places & place) == 0)
      return "a property that is unknown or does not belong there (" + hexadecimal(number) + ")";
    const auto bit = std::uint64_t{1} << number;
    if ((seen & bit) != 0 && found->which != property::user_property)
      return std::string(found->name) + " twice";
    seen |= bit;
    const auto value = value_of(found->how, at);
    if (!at.is_sound())
      return std::string(found->name) + " that is cut off or no text";
    if (value < found->least || value > found->most)
      return std::string(found->name) + " of " + std::to_string(value);
    use(found->which, value);
  }
  return {};
}

} // namespace godwit::io::mqtt
