#include "io/mqtt/properties.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "io/mqtt/cursor.hpp"

namespace godwit::io::mqtt {
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
