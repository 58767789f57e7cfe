// Time and round trips: SYSTEM_TIME, PING, TIMESYNC.
// Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct system_time {
  std::uint64_t time_unix_usec = 0; // us since 1970 UTC
  std::uint32_t time_boot_ms = 0;

  static constexpr std::uint32_t message_id = 2;
  static constexpr std::uint8_t crc_extra = 137;
  GODWIT_FIELDS(system_time, "SYSTEM_TIME", time_unix_usec, time_boot_ms);
};

// Target 0/0 is the question; the answer repeats it and names the asker.
struct ping {
  std::uint64_t time_usec = 0;
  std::uint32_t seq = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;

  static constexpr std::uint32_t message_id = 4;
  static constexpr std::uint8_t crc_extra = 237;
  GODWIT_FIELDS(ping, "PING", time_usec, seq, target_system, target_component);
};

// tc1 = 0 is the question; the answer repeats ts1 and fills tc1 with its own clock.
struct timesync {
  std::int64_t tc1 = 0; // ns
  std::int64_t ts1 = 0; // ns
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;

  static constexpr std::uint32_t message_id = 111;
  static constexpr std::uint8_t crc_extra = 34;
  static constexpr std::size_t extensions = 2;
  GODWIT_FIELDS(timesync, "TIMESYNC", tc1, ts1, target_system, target_component);
};

} // namespace godwit::io::mavlink
