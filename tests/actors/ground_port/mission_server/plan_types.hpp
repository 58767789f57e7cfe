// MAV_MISSION_TYPE, as the stations of these tests say it.
#pragma once

namespace godwit::ground_port::mission_server::test {

inline constexpr int fence = 1;
inline constexpr int rally = 2;
inline constexpr int all = 255;

} // namespace godwit::ground_port::mission_server::test
