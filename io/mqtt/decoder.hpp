// The packets of MQTT 5 that a publisher understands: CONNACK, PUBACK, PINGRESP, DISCONNECT. All others are violations,
// and so is what the standard does not allow: a flag, a length, a property that is unknown, does not belong there, or
// stands there twice.
//
//   packet_reader reader;
//   while (!bytes.empty())
//     if (auto next = reader.read(bytes); !next) ... // a violation: the connection is over
//     else if (*next) ...                            // a packet; BYTES begins after it
//
// A packet is refused as soon as its first byte or its length shows it, before anything of it is kept, so that a reader
// never holds more than max_packet_bytes. The texts of a broker are checked and thrown away: nobody shows them.
//
// Errors: as values, with the reason that a DISCONNECT gives the broker. Thread: pure.
// Source: MQTT Version 5.0 (OASIS), 2.1, 2.2.2, 3.2, 3.4, 3.13, 3.14.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include <tl/expected.hpp>

#include "io/mqtt/reason_code.hpp"

namespace godwit::io::mqtt {

// A packet as a whole. mosquitto's longest is a CONNACK of some 30 bytes; reasons and user properties make it longer.
inline constexpr std::size_t max_packet_bytes = 4096;

struct connack {
  bool is_mqtt_5 = true; // else the answer of an older broker, which means no
  reason_code reason = reason_code::success;
  std::uint16_t receive_maximum = 65'535;
  std::uint8_t maximum_qos = 2;
  bool retain_available = true;
  std::uint32_t maximum_packet_bytes = 0;             // 0: no limit
  std::optional<std::uint16_t> server_keep_alive_s{}; // none: ours holds
};
struct puback {
  std::uint16_t packet_id = 0;
  reason_code reason = reason_code::success;
};
struct pingresp {};
struct disconnect {
  reason_code reason = reason_code::success;
};
using packet = std::variant<connack, puback, pingresp, disconnect>;

struct violation {
  reason_code answer = reason_code::malformed_packet;
  std::string sentence; // "sends PUBLISH, which nobody has asked for"
};

class packet_reader {
public:
  // Takes from the front of BYTES what belongs to the next packet. None: all are taken, and more are needed. After a
  // violation it gives that again and takes nothing.
  [[nodiscard]] tl::expected<std::optional<packet>, violation> read(std::string_view& bytes);
  // Of a packet that is not whole yet.
  [[nodiscard]] std::size_t held_bytes() const { return body_.size(); }

private:
  enum class step { first_byte, length, body };
  using checked = std::optional<violation>;

  [[nodiscard]] checked take_first(std::uint8_t byte);
  [[nodiscard]] checked take_length(std::uint8_t byte);

  step step_ = step::first_byte;
  std::uint8_t first_ = 0;
  std::size_t length_ = 0;
  unsigned length_bytes_ = 0;
  std::string body_;
  checked broken_;
};

// The properties of the packets that a publisher is sent, as one table. Thread: pure.
// Source: MQTT Version 5.0 (OASIS), 2.2.2.2 and table 2-4.

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
