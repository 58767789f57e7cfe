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
  static constexpr auto fields = table("SYSTEM_TIME", field("time_unix_usec", &system_time::time_unix_usec),
                                       field("time_boot_ms", &system_time::time_boot_ms));
};

// Target 0/0 is the question; the answer repeats it and names the asker.
struct ping {
  std::uint64_t time_usec = 0;
  std::uint32_t seq = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;

  static constexpr std::uint32_t message_id = 4;
  static constexpr std::uint8_t crc_extra = 237;
  static constexpr auto fields =
      table("PING", field("time_usec", &ping::time_usec), field("seq", &ping::seq),
            field("target_system", &ping::target_system), field("target_component", &ping::target_component));
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
  static constexpr auto fields =
      table("TIMESYNC", field("tc1", &timesync::tc1), field("ts1", &timesync::ts1),
            field("target_system", &timesync::target_system), field("target_component", &timesync::target_component));
};

} // namespace godwit::io::mavlink
