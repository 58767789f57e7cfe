// What the vehicle's messages mean to the failsafe.
//
// The battery is what SYS_STATUS says, and nothing else: two gauges that differ would look like one that jumps.
// Heights are above home, which PX4 and ArduPilot set where they arm. Thread: pure. Source: MAVLink's common.xml.
#pragma once

#include "actors/failsafe/events.hpp"
#include "io/mavlink/messages/current_mode.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/mavlink/messages/mission.hpp"
#include "io/mavlink/messages/position.hpp"

namespace godwit::failsafe {

[[nodiscard]] heartbeat sense(const io::mavlink::heartbeat& m);
[[nodiscard]] modes_told sense(const io::mavlink::current_mode& m);
[[nodiscard]] landed sense(const io::mavlink::extended_sys_state& m);
[[nodiscard]] position sense(const io::mavlink::global_position_int& m);
[[nodiscard]] home_told sense(const io::mavlink::home_position& m);
[[nodiscard]] battery sense(const io::mavlink::sys_status& m);
[[nodiscard]] autopilot_text sense(const io::mavlink::statustext& m);
[[nodiscard]] mission_current sense(const io::mavlink::mission_current& m);

} // namespace godwit::failsafe
