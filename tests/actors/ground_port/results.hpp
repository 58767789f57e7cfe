// MAV_RESULT, as the stations of these tests hear it.
#pragma once

#include "io/mavlink/enums/command.hpp"

namespace godwit::ground_port {

inline constexpr int accepted = static_cast<int>(io::mavlink::mav_result::accepted);
inline constexpr int temporarily_rejected = static_cast<int>(io::mavlink::mav_result::temporarily_rejected);
inline constexpr int denied = static_cast<int>(io::mavlink::mav_result::denied);
inline constexpr int unsupported = static_cast<int>(io::mavlink::mav_result::unsupported);
inline constexpr int failed = static_cast<int>(io::mavlink::mav_result::failed);
inline constexpr int in_progress = static_cast<int>(io::mavlink::mav_result::in_progress);

} // namespace godwit::ground_port
