// Integers that stations send as floats. Thread: pure.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace godwit::ground_port {

// VALUE as an integer, if it is one from LEAST to MOST. Compared as floats, so that no conversion overflows.
[[nodiscard]] inline std::optional<std::int64_t> integer_in(float value, std::int64_t least, std::int64_t most) {
  if (!std::isfinite(value) || std::trunc(value) != value || value < static_cast<float>(least) ||
      value > static_cast<float>(most))
    return std::nullopt;
  return static_cast<std::int64_t>(value);
}

[[nodiscard]] inline std::optional<std::uint32_t> message_id_in(float value) {
  constexpr std::int64_t most = (1 << 24) - 1; // what a frame has room for, and a float holds exactly
  const auto id = integer_in(value, 0, most);
  return id ? std::optional(static_cast<std::uint32_t>(*id)) : std::nullopt;
}

} // namespace godwit::ground_port
