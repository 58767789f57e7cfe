// A byte of a payload; zeros at its end may be cut off (MAVLink 2). Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>

#include "io/mavlink/wire_format.hpp"

namespace godwit::ground_port::passing {

[[nodiscard]] inline std::uint8_t byte_at(io::mavlink::byte_view payload, std::size_t at) {
  return at < payload.size() ? std::to_integer<std::uint8_t>(payload[at]) : std::uint8_t{0};
}

} // namespace godwit::ground_port::passing
