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

constexpr auto enum_names(mav_type) {
  return names<mav_type>({{mav_type::generic, "generic"},
                          {mav_type::fixed_wing, "fixed_wing"},
                          {mav_type::quadrotor, "quadrotor"},
                          {mav_type::coaxial, "coaxial"},
                          {mav_type::helicopter, "helicopter"},
                          {mav_type::antenna_tracker, "antenna_tracker"},
                          {mav_type::gcs, "gcs"},
                          {mav_type::ground_rover, "ground_rover"},
                          {mav_type::surface_boat, "surface_boat"},
                          {mav_type::submarine, "submarine"},
                          {mav_type::hexarotor, "hexarotor"},
                          {mav_type::octorotor, "octorotor"},
                          {mav_type::tricopter, "tricopter"},
                          {mav_type::onboard_controller, "onboard_controller"},
                          {mav_type::vtol_tailsitter_duorotor, "vtol_tailsitter_duorotor"},
                          {mav_type::vtol_tailsitter_quadrotor, "vtol_tailsitter_quadrotor"},
                          {mav_type::vtol_tiltrotor, "vtol_tiltrotor"},
                          {mav_type::vtol_fixedrotor, "vtol_fixedrotor"}});
}

enum class mav_autopilot : std::uint8_t {
  generic = 0,
  ardupilotmega = 3,
  invalid = 8,
  px4 = 12,
};

constexpr auto enum_names(mav_autopilot) {
  return names<mav_autopilot>({{mav_autopilot::generic, "generic"},
                               {mav_autopilot::ardupilotmega, "ardupilotmega"},
                               {mav_autopilot::invalid, "invalid"},
                               {mav_autopilot::px4, "px4"}});
}

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

constexpr auto enum_names(mav_state) {
  return names<mav_state>({{mav_state::uninit, "uninit"},
                           {mav_state::boot, "boot"},
                           {mav_state::calibrating, "calibrating"},
                           {mav_state::standby, "standby"},
                           {mav_state::active, "active"},
                           {mav_state::critical, "critical"},
                           {mav_state::emergency, "emergency"},
                           {mav_state::poweroff, "poweroff"},
                           {mav_state::flight_termination, "flight_termination"}});
}

enum class mav_landed_state : std::uint8_t {
  undefined = 0,
  on_ground = 1,
  in_air = 2,
  takeoff = 3,
  landing = 4,
};

constexpr auto enum_names(mav_landed_state) {
  return names<mav_landed_state>({{mav_landed_state::undefined, "undefined"},
                                  {mav_landed_state::on_ground, "on_ground"},
                                  {mav_landed_state::in_air, "in_air"},
                                  {mav_landed_state::takeoff, "takeoff"},
                                  {mav_landed_state::landing, "landing"}});
}

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

constexpr auto enum_names(mav_severity) {
  return names<mav_severity>({{mav_severity::emergency, "emergency"},
                              {mav_severity::alert, "alert"},
                              {mav_severity::critical, "critical"},
                              {mav_severity::error, "error"},
                              {mav_severity::warning, "warning"},
                              {mav_severity::notice, "notice"},
                              {mav_severity::info, "info"},
                              {mav_severity::debug, "debug"}});
}

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

constexpr auto enum_names(gps_fix_type) {
  return names<gps_fix_type>({{gps_fix_type::no_gps, "no_gps"},
                              {gps_fix_type::no_fix, "no_fix"},
                              {gps_fix_type::fix_2d, "fix_2d"},
                              {gps_fix_type::fix_3d, "fix_3d"},
                              {gps_fix_type::dgps, "dgps"},
                              {gps_fix_type::rtk_float, "rtk_float"},
                              {gps_fix_type::rtk_fixed, "rtk_fixed"},
                              {gps_fix_type::fixed_position, "fixed_position"},
                              {gps_fix_type::ppp, "ppp"}});
}

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

constexpr auto enum_names(mav_mode_flag) {
  return names<mav_mode_flag>({{mav_mode_flag::custom_mode_enabled, "custom_mode_enabled"},
                               {mav_mode_flag::test_enabled, "test_enabled"},
                               {mav_mode_flag::auto_enabled, "auto_enabled"},
                               {mav_mode_flag::guided_enabled, "guided_enabled"},
                               {mav_mode_flag::stabilize_enabled, "stabilize_enabled"},
                               {mav_mode_flag::hil_enabled, "hil_enabled"},
                               {mav_mode_flag::manual_input_enabled, "manual_input_enabled"},
                               {mav_mode_flag::safety_armed, "safety_armed"}});
}

// Component ids.
enum class mav_component : std::uint8_t {
  all = 0,
  autopilot1 = 1,
  missionplanner = 190,
  onboard_computer = 191,
};

constexpr auto enum_names(mav_component) {
  return names<mav_component>({{mav_component::all, "all"},
                               {mav_component::autopilot1, "autopilot1"},
                               {mav_component::missionplanner, "missionplanner"},
                               {mav_component::onboard_computer, "onboard_computer"}});
}

} // namespace godwit::io::mavlink
