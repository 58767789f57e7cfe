// SETUP_SIGNING: hands a key to a peer. Sent only over a link that nobody else hears, never forwarded, never logged.
// The key is a secret of the field table: no rendering shows it. Source: MAVLink's common.xml, whose names and order of
// fields are kept.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

// A key of zeros with timestamp 0 switches signing off.
struct setup_signing {
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::array<std::uint8_t, 32> secret_key{};
  std::uint64_t initial_timestamp = 0; // 10 us since 2015-01-01 UTC

  static constexpr std::uint32_t message_id = 256;
  static constexpr std::uint8_t crc_extra = 71;
  static constexpr auto fields = table("SETUP_SIGNING", field("target_system", &setup_signing::target_system),
                                       field("target_component", &setup_signing::target_component),
                                       secret("secret_key", &setup_signing::secret_key),
                                       field("initial_timestamp", &setup_signing::initial_timestamp));
};

} // namespace godwit::io::mavlink
