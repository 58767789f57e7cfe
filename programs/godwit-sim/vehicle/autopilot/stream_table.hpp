// Which messages each autopilot streams, and how often; and the groups in which an older station asks for them.
//
// Intervals are those that were recorded: PX4 on the link to a ground station, ArduPilot before anybody has asked.
// Interval 0: known, and sent only when asked for with SET_MESSAGE_INTERVAL. MISSION_CURRENT is not here, because it
// also follows changes. Thread: constants. Source: recordings; MAV_DATA_STREAM for the groups.
#pragma once

#include <cstdint>
#include <span>

#include "actors/ground_port/vehicle_role/message_schedule.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"

namespace godwit::sim {

using stream_table = std::span<const role::streamed_message>;

[[nodiscard]] stream_table rover_streams();
[[nodiscard]] stream_table px4_streams();
[[nodiscard]] stream_table ardupilot_streams();

// REQUEST_DATA_STREAM names a group; 0 means all of them.
struct stream_group {
  std::uint8_t number = 0; // MAV_DATA_STREAM
  std::uint32_t message = 0;
};

[[nodiscard]] std::span<const stream_group> stream_groups();

} // namespace godwit::sim
