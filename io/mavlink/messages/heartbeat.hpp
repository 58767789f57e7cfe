// Who is there and how it fares: HEARTBEAT, SYS_STATUS, EXTENDED_SYS_STATE, STATUSTEXT.
// Source: MAVLink's minimal.xml and common.xml, whose names and order of fields are kept.
#pragma once

#include <array>
#include <cstdint>

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
  static constexpr auto fields =
      table("HEARTBEAT", field("type", &heartbeat::type), field("autopilot", &heartbeat::autopilot),
            field("base_mode", &heartbeat::base_mode), field("custom_mode", &heartbeat::custom_mode),
            field("system_status", &heartbeat::system_status), field("mavlink_version", &heartbeat::mavlink_version));
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
  static constexpr auto fields =
      table("SYS_STATUS", field("onboard_control_sensors_present", &sys_status::onboard_control_sensors_present),
            field("onboard_control_sensors_enabled", &sys_status::onboard_control_sensors_enabled),
            field("onboard_control_sensors_health", &sys_status::onboard_control_sensors_health),
            field("load", &sys_status::load), field("voltage_battery", &sys_status::voltage_battery),
            field("current_battery", &sys_status::current_battery),
            field("battery_remaining", &sys_status::battery_remaining),
            field("drop_rate_comm", &sys_status::drop_rate_comm), field("errors_comm", &sys_status::errors_comm),
            field("errors_count1", &sys_status::errors_count1), field("errors_count2", &sys_status::errors_count2),
            field("errors_count3", &sys_status::errors_count3), field("errors_count4", &sys_status::errors_count4),
            field("onboard_control_sensors_present_extended", &sys_status::onboard_control_sensors_present_extended),
            field("onboard_control_sensors_enabled_extended", &sys_status::onboard_control_sensors_enabled_extended),
            field("onboard_control_sensors_health_extended", &sys_status::onboard_control_sensors_health_extended));
};

struct extended_sys_state {
  std::uint8_t vtol_state = 0;
  std::uint8_t landed_state = 0; // mav_landed_state

  static constexpr std::uint32_t message_id = 245;
  static constexpr std::uint8_t crc_extra = 130;
  static constexpr auto fields = table("EXTENDED_SYS_STATE", field("vtol_state", &extended_sys_state::vtol_state),
                                       field("landed_state", &extended_sys_state::landed_state));
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
  static constexpr auto fields =
      table("STATUSTEXT", field("severity", &statustext::severity), field("text", &statustext::text),
            field("id", &statustext::id), field("chunk_seq", &statustext::chunk_seq));
};

} // namespace godwit::io::mavlink
