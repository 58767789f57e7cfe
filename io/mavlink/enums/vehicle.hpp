// The numbers in messages about a vehicle: what it is, how it fares. See io/mavlink/enums.hpp.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::io::mavlink {

// What a system is.
enum class mav_type : std::uint8_t {
  generic = 0,
  fixed_wing = 1,
  quadrotor = 2,
  coaxial = 3,
  helicopter = 4,
  antenna_tracker = 5,
  gcs = 6,
  ground_rover = 10,
  surface_boat = 11,
  submarine = 12,
  hexarotor = 13,
  octorotor = 14,
  tricopter = 15,
  onboard_controller = 18,
  vtol_tailsitter_duorotor = 19,
  vtol_tailsitter_quadrotor = 20,
  vtol_tiltrotor = 21,
  vtol_fixedrotor = 22,
};

GODWIT_ENUM_NAMES(mav_type, generic, fixed_wing, quadrotor, coaxial, helicopter, antenna_tracker, gcs, ground_rover,
                  surface_boat, submarine, hexarotor, octorotor, tricopter, onboard_controller,
                  vtol_tailsitter_duorotor, vtol_tailsitter_quadrotor, vtol_tiltrotor, vtol_fixedrotor);

enum class mav_autopilot : std::uint8_t {
  generic = 0,
  ardupilotmega = 3,
  invalid = 8,
  px4 = 12,
};

GODWIT_ENUM_NAMES(mav_autopilot, generic, ardupilotmega, invalid, px4);

enum class mav_state : std::uint8_t {
  uninit = 0,
  boot = 1,
  calibrating = 2,
  standby = 3,
  active = 4,
  critical = 5,
  emergency = 6,
  poweroff = 7,
  flight_termination = 8,
};

GODWIT_ENUM_NAMES(mav_state, uninit, boot, calibrating, standby, active, critical, emergency, poweroff,
                  flight_termination);

enum class mav_landed_state : std::uint8_t {
  undefined = 0,
  on_ground = 1,
  in_air = 2,
  takeoff = 3,
  landing = 4,
};

GODWIT_ENUM_NAMES(mav_landed_state, undefined, on_ground, in_air, takeoff, landing);

// As in RFC 5424.
enum class mav_severity : std::uint8_t {
  emergency = 0,
  alert = 1,
  critical = 2,
  error = 3,
  warning = 4,
  notice = 5,
  info = 6,
  debug = 7,
};

GODWIT_ENUM_NAMES(mav_severity, emergency, alert, critical, error, warning, notice, info, debug);

// What a satellite receiver can tell.
enum class gps_fix_type : std::uint8_t {
  no_gps = 0,
  no_fix = 1,
  fix_2d = 2,
  fix_3d = 3,
  dgps = 4,
  rtk_float = 5,
  rtk_fixed = 6,
  fixed_position = 7,
  ppp = 8,
};

GODWIT_ENUM_NAMES(gps_fix_type, no_gps, no_fix, fix_2d, fix_3d, dgps, rtk_float, rtk_fixed, fixed_position, ppp);

// Bits of HEARTBEAT.base_mode.
enum class mav_mode_flag : std::uint8_t {
  custom_mode_enabled = 1,
  test_enabled = 2,
  auto_enabled = 4,
  guided_enabled = 8,
  stabilize_enabled = 16,
  hil_enabled = 32,
  manual_input_enabled = 64,
  safety_armed = 128,
};

GODWIT_ENUM_NAMES(mav_mode_flag, custom_mode_enabled, test_enabled, auto_enabled, guided_enabled, stabilize_enabled,
                  hil_enabled, manual_input_enabled, safety_armed);

// Component ids.
enum class mav_component : std::uint8_t {
  all = 0,
  autopilot1 = 1,
  missionplanner = 190,
  onboard_computer = 191,
};

GODWIT_ENUM_NAMES(mav_component, all, autopilot1, missionplanner, onboard_computer);

} // namespace godwit::io::mavlink
