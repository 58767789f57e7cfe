// The reason codes of MQTT 5 that a publisher meets. Thread: plain values; pure.
// Source: MQTT Version 5.0 (OASIS), 2.4 and table 2-6.
#pragma once

#include <cstdint>
#include <string>

namespace godwit::io::mqtt {

enum class reason_code : std::uint8_t {
  success = 0x00,
  disconnect_with_will = 0x04,
  no_matching_subscribers = 0x10,
  malformed_packet = 0x81,
  protocol_error = 0x82,
  unsupported_protocol = 0x84,
  bad_user_or_password = 0x86,
  not_authorised = 0x87,
  banned = 0x8A,
  bad_authentication_method = 0x8C,
  session_taken_over = 0x8E,
  packet_too_large = 0x95,
  retain_not_supported = 0x9A,
};

// From here on they mean no.
inline constexpr std::uint8_t first_refusal = 0x80;

[[nodiscard]] constexpr bool is_refusal(reason_code code) { return static_cast<std::uint8_t>(code) >= first_refusal; }

// As the standard calls it; of a number that it does not know: "reason 0x7f".
[[nodiscard]] std::string name_of(reason_code code);

} // namespace godwit::io::mqtt
