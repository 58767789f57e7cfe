// Who is there and how it fares: HEARTBEAT, SYS_STATUS, EXTENDED_SYS_STATE, STATUSTEXT.
// Source: MAVLink's minimal.xml and common.xml, whose names and order of fields are kept.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

// At 1 Hz from everybody. Numbers are of the enums in io/mavlink/enums.hpp; an unknown one stays as it came.
struct heartbeat {
  std::uint8_t type = 0;            // mav_type
  std::uint8_t autopilot = 0;       // mav_autopilot
  std::uint8_t base_mode = 0;       // mav_mode_flag
  std::uint32_t custom_mode = 0;    // means what the autopilot says
  std::uint8_t system_status = 0;   // mav_state
  std::uint8_t mavlink_version = 3; // the only field that a sender may not choose

  static constexpr std::uint32_t message_id = 0;
  static constexpr std::uint8_t crc_extra = 50;
  GODWIT_FIELDS(heartbeat, "HEARTBEAT", type, autopilot, base_mode, custom_mode, system_status, mavlink_version);
};

struct sys_status {
  std::uint32_t onboard_control_sensors_present = 0;
  std::uint32_t onboard_control_sensors_enabled = 0;
  std::uint32_t onboard_control_sensors_health = 0;
  std::uint16_t load = 0;            // 0.1 %
  std::uint16_t voltage_battery = 0; // mV
  std::int16_t current_battery = 0;  // cA, -1 unknown
  std::int8_t battery_remaining = 0; // %, -1 unknown
  std::uint16_t drop_rate_comm = 0;  // 0.01 %
  std::uint16_t errors_comm = 0;
  std::uint16_t errors_count1 = 0;
  std::uint16_t errors_count2 = 0;
  std::uint16_t errors_count3 = 0;
  std::uint16_t errors_count4 = 0;
  std::uint32_t onboard_control_sensors_present_extended = 0;
  std::uint32_t onboard_control_sensors_enabled_extended = 0;
  std::uint32_t onboard_control_sensors_health_extended = 0;

  static constexpr std::uint32_t message_id = 1;
  static constexpr std::uint8_t crc_extra = 124;
  static constexpr std::size_t extensions = 3;
  GODWIT_FIELDS(sys_status, "SYS_STATUS", onboard_control_sensors_present, onboard_control_sensors_enabled,
                onboard_control_sensors_health, load, voltage_battery, current_battery, battery_remaining,
                drop_rate_comm, errors_comm, errors_count1, errors_count2, errors_count3, errors_count4,
                onboard_control_sensors_present_extended, onboard_control_sensors_enabled_extended,
                onboard_control_sensors_health_extended);
};

struct extended_sys_state {
  std::uint8_t vtol_state = 0;
  std::uint8_t landed_state = 0; // mav_landed_state

  static constexpr std::uint32_t message_id = 245;
  static constexpr std::uint8_t crc_extra = 130;
  GODWIT_FIELDS(extended_sys_state, "EXTENDED_SYS_STATE", vtol_state, landed_state);
};

// The text fills all 50 characters or ends with a NUL. Longer texts come in several frames with the same id.
struct statustext {
  std::uint8_t severity = 0; // mav_severity
  std::array<char, 50> text{};
  std::uint16_t id = 0; // 0: this is the whole text
  std::uint8_t chunk_seq = 0;

  static constexpr std::uint32_t message_id = 253;
  static constexpr std::uint8_t crc_extra = 83;
  static constexpr std::size_t extensions = 2;
  GODWIT_FIELDS(statustext, "STATUSTEXT", severity, text, id, chunk_seq);
};

// CURRENT_MODE: the mode that the vehicle is in, and the one that somebody has asked for last. They differ where a
// failsafe of the autopilot has left the mode that was asked for, or where the vehicle can not enter it.
// Source: MAVLink's standard modes (common.xml), whose names and order of fields are kept.
struct current_mode {
  std::uint8_t standard_mode = 0;         // MAV_STANDARD_MODE; 0: none that it could name
  std::uint32_t custom_mode = 0;          // as in HEARTBEAT
  std::uint32_t intended_custom_mode = 0; // 0: not told

  static constexpr std::uint32_t message_id = 436;
  static constexpr std::uint8_t crc_extra = 193;
  GODWIT_FIELDS(current_mode, "CURRENT_MODE", standard_mode, custom_mode, intended_custom_mode);
};

// What the flags of a HEARTBEAT say. Source: MAV_MODE_FLAG. Thread: any.
[[nodiscard]] constexpr bool is_armed(const heartbeat& m) {
  return (m.base_mode & number(mav_mode_flag::safety_armed)) != 0;
}

} // namespace godwit::io::mavlink
