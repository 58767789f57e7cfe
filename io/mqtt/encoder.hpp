// The packets of MQTT 5 that a publisher sends: CONNECT with a will, PUBLISH with QoS 0 or 1, PINGREQ, DISCONNECT.
//
// Errors: a sentence about what no packet can hold. Thread: pure.
// Source: MQTT Version 5.0 (OASIS), 3.1, 3.3, 3.12, 3.14.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "io/mqtt/message.hpp"
#include "io/mqtt/reason_code.hpp"

namespace godwit::io::mqtt {

using encoded = tl::expected<std::string, std::string>;

// What a packet of ours may have at most: far above each text that there is.
inline constexpr std::size_t max_sent_bytes = std::size_t{1024} * 1024;

struct connect_request {
  std::string_view client_id;
  std::string_view username;                // empty: none
  std::optional<std::string_view> password; // not without a user
  std::uint16_t keep_alive_s = 0;
  std::uint32_t max_packet_bytes = 0; // what the broker may send
};

// A clean start, and a session that ends with the connection. WILL: with QoS 1. The text is as long as its room, so
// that no copy of a password stays behind.
[[nodiscard]] encoded encode_connect(const connect_request& what, const message& will);

// PACKET_ID: not 0 for a message that is to be acknowledged, 0 for another one.
[[nodiscard]] encoded encode_publish(const message& what, std::uint16_t packet_id);

// How long that packet is at most.
[[nodiscard]] std::size_t publish_bytes(std::size_t topic_bytes, std::size_t payload_bytes);

[[nodiscard]] std::string encode_ping();
[[nodiscard]] std::string encode_disconnect(reason_code why);

} // namespace godwit::io::mqtt
