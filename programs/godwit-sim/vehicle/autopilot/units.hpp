// Units of MAVLink's integers. Thread: pure.
#pragma once

#include <cmath>
#include <cstdint>

#include "io/mavlink/frame_meaning.hpp"

namespace godwit::sim {

[[nodiscard]] inline std::int32_t e7(double degrees) {
  return static_cast<std::int32_t>(std::lround(degrees * io::mavlink::units_of(io::mavlink::coordinate_kind::global)));
}

} // namespace godwit::sim
