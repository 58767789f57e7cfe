// The time in signatures: 48 bits, in units of 10 microseconds since 2015-01-01 00:00 UTC, which last until 2104.
//
// A type of its own, so that it is never mixed up with nanoseconds. Thread: pure. Source: the MAVLink guide, "Message
// Signing".
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace godwit::io::mavlink {

enum class signing_time : std::uint64_t {};

inline constexpr signing_time max_signing_time{(std::uint64_t{1} << 48U) - 1};
inline constexpr std::int64_t signing_epoch_s = 1'420'070'400; // 2015-01-01 in seconds since 1970
inline constexpr std::int64_t signing_unit_ns = 10'000;
inline constexpr std::uint64_t signing_units_per_s = 100'000;
inline constexpr std::size_t signing_time_size = 6; // bytes on the wire, little-endian

[[nodiscard]] constexpr std::uint64_t units(signing_time time) { return static_cast<std::uint64_t>(time); }

// WALL_NS is nanoseconds since 1970, UTC. A clock that was never set gives the beginning, never something wrapped.
[[nodiscard]] constexpr signing_time signing_time_at(std::int64_t wall_ns) {
  constexpr std::int64_t epoch_ns = signing_epoch_s * 1'000'000'000;
  const std::int64_t since_ns = std::max<std::int64_t>(wall_ns, epoch_ns) - epoch_ns;
  return signing_time{
      std::min<std::uint64_t>(static_cast<std::uint64_t>(since_ns / signing_unit_ns), units(max_signing_time))};
}

// TIME and a DURATION in units later, at most the last time that there is.
[[nodiscard]] constexpr signing_time later(signing_time time, std::uint64_t duration) {
  const std::uint64_t left = units(max_signing_time) - units(time);
  return signing_time{units(time) + std::min(left, duration)};
}

[[nodiscard]] constexpr signing_time load_signing_time(std::span<const std::byte, signing_time_size> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;)
    value = value << 8U | std::to_integer<std::uint64_t>(bytes[i]);
  return signing_time{value};
}

constexpr void store_signing_time(std::span<std::byte, signing_time_size> to, signing_time time) {
  for (std::size_t i = 0; i < to.size(); ++i)
    to[i] = static_cast<std::byte>(units(time) >> (8U * i));
}

} // namespace godwit::io::mavlink
