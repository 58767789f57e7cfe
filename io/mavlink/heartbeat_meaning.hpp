// What the flags of a HEARTBEAT say. Source: MAV_MODE_FLAG. Thread: any.
#pragma once

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::io::mavlink {

[[nodiscard]] constexpr bool is_armed(const heartbeat& m) {
  return (m.base_mode & number(mav_mode_flag::safety_armed)) != 0;
}

} // namespace godwit::io::mavlink
