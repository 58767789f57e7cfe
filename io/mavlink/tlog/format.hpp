// The .tlog format of ground stations: one record after the other, without a header.
//
//   time[8] frame     time: microseconds since 1970 UTC, big-endian (alone so in all of MAVLink); frame: as on the wire
//
// Source: what QGroundControl, MAVProxy and pymavlink write and read. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "io/mavlink/wire_format.hpp"

namespace godwit::io::mavlink {

inline constexpr std::size_t tlog_time_size = 8;
inline constexpr std::size_t max_tlog_record_size = tlog_time_size + max_frame_size;

[[nodiscard]] constexpr std::uint64_t load_tlog_time(std::span<const std::byte, tlog_time_size> bytes) {
  std::uint64_t time_us = 0;
  for (const std::byte each : bytes)
    time_us = time_us << 8U | std::to_integer<std::uint64_t>(each);
  return time_us;
}

constexpr void store_tlog_time(std::span<std::byte, tlog_time_size> to, std::uint64_t time_us) {
  for (std::size_t i = to.size(); i-- > 0; time_us >>= 8U)
    to[i] = static_cast<std::byte>(time_us);
}

} // namespace godwit::io::mavlink
