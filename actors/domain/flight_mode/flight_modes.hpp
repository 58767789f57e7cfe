// The flight modes of each autopilot: what a number comes down to, and which number is asked for.
//
//   mode_of(heartbeat)                              what the vehicle does now
//   mode_command(heartbeat, mode_kind::hold)        DO_SET_MODE with the number that means it
//
// PX4 has one table for all vehicles, ArduPilot one for each class. A vehicle of another make is taken to number its
// modes as ArduPilot does for its class: that is what MAVLink's own examples do. A number that is not in the table is
// `unknown`: nobody may be sure then who flies. Thread: pure.
//
// Source: PX4's px4_custom_mode.h; ArduPilot's mode.h of Copter, Plane and Rover; MAV_CMD_DO_SET_MODE.
#pragma once

#include <optional>

#include "io/mavlink/enums/vehicle.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "messages/flight/flight_mode.hpp"
#include "messages/flight/vehicle_class.hpp"
#include "messages/vehicle_link/command.hpp"

namespace godwit::flight {

// Whose table counts.
struct mode_owner {
  io::mavlink::mav_autopilot autopilot = io::mavlink::mav_autopilot::generic;
  vehicle_class vehicle = vehicle_class::unknown;
  friend bool operator==(const mode_owner&, const mode_owner&) = default;
};

[[nodiscard]] mode_owner owner_of(const io::mavlink::heartbeat& m);

[[nodiscard]] flight_mode mode_of(const mode_owner& whose, std::uint32_t custom_mode);
[[nodiscard]] flight_mode mode_of(const io::mavlink::heartbeat& m);

// The number that asks for a mode of this kind. None: this vehicle has none, as a fixed wing has no landing mode.
[[nodiscard]] std::optional<std::uint32_t> number_of(const mode_owner& whose, mode_kind kind);

// DO_SET_MODE.
[[nodiscard]] vehicle_link::send_command mode_command(const mode_owner& whose, std::uint32_t custom_mode);
// None as above.
[[nodiscard]] std::optional<vehicle_link::send_command> mode_command(const mode_owner& whose, mode_kind kind);

} // namespace godwit::flight
