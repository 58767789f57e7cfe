// Which frames of the vehicle go on to the ground stations as they came.
//
//   the autopilot's messages of `told`                no: listeners have them already
//   plan transfers, TIMESYNC, PING, keys, commands    no: they are for godwit, or for nobody else
//   COMMAND_ACK, MISSION_ACK, FILE_TRANSFER_PROTOCOL, ...  only where another system than the vehicle's is meant
//   all others of any component of the vehicle        yes
//
// Thread: pure. Source: MAVLink common.xml; the places of the targets by its serialization rules.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "actors/vehicle_link/message_allowlist.hpp"
#include "io/mavlink/frame.hpp"
#include "messages/vehicle_link/evidence.hpp"

namespace godwit::vehicle_link {

namespace relay_gate {

// Where a message that has one names its target system.
struct target_place {
  std::uint32_t message = 0;
  std::size_t at = 0;
};
inline constexpr std::array targeted{
    target_place{47, 0},  // MISSION_ACK: to an item that ground_port has passed on
    target_place{77, 8},  // COMMAND_ACK
    target_place{110, 1}, // FILE_TRANSFER_PROTOCOL
    target_place{413, 4}, // RESPONSE_EVENT_ERROR
};

// Besides those that are taken and used here.
inline constexpr std::array<std::uint32_t, 17> never{
    11,  37,  38,  39,  41,  43,  45, 75, 76, 80, // SET_MODE, the rest of the mission protocol, commands
    109, 126, 160, 161, 175, 176,                 // RADIO_STATUS, SERIAL_CONTROL, old fences and rally points
    256                                           // SETUP_SIGNING
};

// What listeners are not told of them.
inline constexpr std::array<std::uint32_t, 6> told_but_not_forwarded{
    mavlink::adsb_vehicle::message_id,     mavlink::collision::message_id,
    mavlink::current_mode::message_id,     mavlink::ekf_status_report::message_id,
    mavlink::estimator_status::message_id, mavlink::gimbal_device_attitude_status::message_id};

// Bytes that were cut off are 0.
[[nodiscard]] inline std::optional<std::uint8_t> target_of(const mavlink::frame_view& frame) {
  const auto found = std::ranges::find(targeted, frame.id(), &target_place::message);
  if (found == targeted.end())
    return std::nullopt;
  const auto payload = frame.payload();
  return found->at < payload.size() ? std::to_integer<std::uint8_t>(payload[found->at]) : std::uint8_t{0};
}

} // namespace relay_gate

// FRAME is of a component of the vehicle; AUTOPILOT: of the one that flies it.
[[nodiscard]] inline bool goes_to_stations(const mavlink::frame_view& frame, mavlink::sender autopilot) {
  const auto id = frame.id();
  if (const auto target = relay_gate::target_of(frame))
    return *target != 0 && *target != autopilot.system;
  if (used_messages::contains(id) || std::ranges::find(relay_gate::never, id) != relay_gate::never.end())
    return false;
  return frame.from() != autopilot || !told_messages::contains(id) ||
         std::ranges::find(relay_gate::told_but_not_forwarded, id) != relay_gate::told_but_not_forwarded.end();
}

[[nodiscard]] inline relayed_frame as_said(const mavlink::frame_view& frame) {
  relayed_frame result{frame.id(), frame.from().system, frame.from().component, {}};
  result.payload.reserve(frame.payload().size());
  for (const auto each : frame.payload())
    result.payload.push_back(std::to_integer<std::uint8_t>(each));
  return result;
}

} // namespace godwit::vehicle_link
