// A command from a station, in whichever of the two messages it came, and the answer to it. Thread: pure.
//
// Source: MAVLink command protocol, COMMAND_LONG (76), COMMAND_INT (75), COMMAND_ACK (77).
#pragma once

#include <cstdint>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages/command.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::ground_port::vehicle_role {

namespace mavlink = io::mavlink;

struct order {
  mavlink::sender from;
  std::uint16_t command = 0; // MAV_CMD
  std::uint8_t target_component = 0;
  bool is_in_integers = false;   // it came as COMMAND_INT
  bool is_item = false;          // it came as a mission item that is flown at once: MISSION_ACK is its answer
  std::uint8_t confirmation = 0; // COMMAND_LONG only
  float param1 = 0;
  float param2 = 0;
  float param3 = 0;
  float param4 = 0;
  double x = 0;           // param5: latitude in degrees in the global frames, whatever the message
  double y = 0;           // param6: longitude
  float z = 0;            // param7
  std::uint8_t frame = 0; // MAV_FRAME; COMMAND_LONG has none: global with relative altitude is meant
};

[[nodiscard]] order read_order(mavlink::sender from, const mavlink::command_long& m);
[[nodiscard]] order read_order(mavlink::sender from, const mavlink::command_int& m);
// An item with `current` = 2 is no part of a plan for an ArduPilot: it flies there at once, in GUIDED. Older stations
// say "go to" so. It is read as DO_REPOSITION.
inline constexpr std::uint8_t item_to_fly_to = 2;
inline constexpr std::uint8_t item_with_altitude = 3; // the altitude alone is meant
[[nodiscard]] order read_order(mavlink::sender from, const mavlink::mission_item_int& m);

// PROGRESS: percent, with IN_PROGRESS alone.
[[nodiscard]] mavlink::command_ack answer_to(const order& what, mavlink::mav_result result, std::uint8_t progress = 0,
                                             std::int32_t result_param2 = 0);

} // namespace godwit::ground_port::vehicle_role
