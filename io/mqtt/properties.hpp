// The properties of the packets that a publisher is sent, as one table. Thread: pure.
// Source: MQTT Version 5.0 (OASIS), 2.2.2.2 and table 2-4.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace godwit::io::mqtt {

// A bit for each packet that may hold it.
enum property_place : std::uint8_t { in_connack = 1, in_puback = 2, in_disconnect = 4 };

enum class property : std::uint8_t {
  session_expiry_interval = 0x11,
  server_keep_alive = 0x13,
  server_reference = 0x1C,
  reason_string = 0x1F,
  receive_maximum = 0x21,
  topic_alias_maximum = 0x22,
  maximum_qos = 0x24,
  retain_available = 0x25,
  user_property = 0x26,
  maximum_packet_size = 0x27,
  wildcard_subscription_available = 0x28,
  subscription_identifiers_available = 0x29,
  shared_subscription_available = 0x2A,
};

// What BYTES holds: the length of the properties, and they themselves, up to the end. USE: is given each number. The
// objection: what is wrong with them; none: they are sound.
[[nodiscard]] std::optional<std::string> read_properties(std::string_view bytes, property_place place,
                                                         const std::function<void(property, std::uint32_t)>& use);

} // namespace godwit::io::mqtt
