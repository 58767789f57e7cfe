// What the peer is: AUTOPILOT_VERSION, PROTOCOL_VERSION.
// Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct autopilot_version {
  std::uint64_t capabilities = 0;
  std::uint32_t flight_sw_version = 0;
  std::uint32_t middleware_sw_version = 0;
  std::uint32_t os_sw_version = 0;
  std::uint32_t board_version = 0;
  std::array<std::uint8_t, 8> flight_custom_version{};
  std::array<std::uint8_t, 8> middleware_custom_version{};
  std::array<std::uint8_t, 8> os_custom_version{};
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::uint64_t uid = 0;
  std::array<std::uint8_t, 18> uid2{};

  static constexpr std::uint32_t message_id = 148;
  static constexpr std::uint8_t crc_extra = 178;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(autopilot_version, "AUTOPILOT_VERSION", capabilities, flight_sw_version, middleware_sw_version,
                os_sw_version, board_version, flight_custom_version, middleware_custom_version, os_custom_version,
                vendor_id, product_id, uid, uid2);
};

struct protocol_version {
  std::uint16_t version = 0;
  std::uint16_t min_version = 0;
  std::uint16_t max_version = 0;
  std::array<std::uint8_t, 8> spec_version_hash{};
  std::array<std::uint8_t, 8> library_version_hash{};

  static constexpr std::uint32_t message_id = 300;
  static constexpr std::uint8_t crc_extra = 217;
  GODWIT_FIELDS(protocol_version, "PROTOCOL_VERSION", version, min_version, max_version, spec_version_hash,
                library_version_hash);
};

} // namespace godwit::io::mavlink
