// A number that tells contents apart, for the trace: FNV-1a, 64 bits. Not against somebody who wants them to collide.
// Source: RFC 9923. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace godwit::runtime {

inline constexpr std::uint64_t empty_hash = 0xcbf2'9ce4'8422'2325;

[[nodiscard]] inline std::uint64_t content_hash(std::span<const std::byte> bytes, std::uint64_t before = empty_hash) {
  constexpr std::uint64_t prime = 0x100'0000'01b3;
  for (const auto each : bytes)
    before = (before ^ std::to_integer<std::uint64_t>(each)) * prime;
  return before;
}

[[nodiscard]] inline std::uint64_t content_hash(std::string_view text, std::uint64_t before = empty_hash) {
  return content_hash(std::as_bytes(std::span(text)), before);
}

} // namespace godwit::runtime
