// FENCE_STATUS. Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct fence_status {
  std::uint8_t breach_status = 0; // 1 outside
  std::uint16_t breach_count = 0;
  std::uint8_t breach_type = 0;
  std::uint32_t breach_time = 0; // ms since boot
  std::uint8_t breach_mitigation = 0;

  static constexpr std::uint32_t message_id = 162;
  static constexpr std::uint8_t crc_extra = 189;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(fence_status, "FENCE_STATUS", breach_status, breach_count, breach_type, breach_time, breach_mitigation);
};

} // namespace godwit::io::mavlink
