// BATTERY_STATUS. Source: MAVLink's common.xml, whose names and order of fields are kept.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

struct battery_status {
  std::uint8_t id = 0;
  std::uint8_t battery_function = 0;
  std::uint8_t type = 0;
  std::int16_t temperature = 0;             // 0.01 degrees C, 32767 unknown
  std::array<std::uint16_t, 10> voltages{}; // mV, 65535 no such cell
  std::int16_t current_battery = 0;         // cA, -1 unknown
  std::int32_t current_consumed = 0;        // mAh, -1 unknown
  std::int32_t energy_consumed = 0;         // hJ, -1 unknown
  std::int8_t battery_remaining = 0;        // %, -1 unknown
  std::int32_t time_remaining = 0;          // s, 0 unknown
  std::uint8_t charge_state = 0;
  std::array<std::uint16_t, 4> voltages_ext{}; // mV, 0 no such cell
  std::uint8_t mode = 0;
  std::uint32_t fault_bitmask = 0;

  static constexpr std::uint32_t message_id = 147;
  static constexpr std::uint8_t crc_extra = 154;
  static constexpr std::size_t extensions = 5;
  GODWIT_FIELDS(battery_status, "BATTERY_STATUS", id, battery_function, type, temperature, voltages, current_battery,
                current_consumed, energy_consumed, battery_remaining, time_remaining, charge_state, voltages_ext, mode,
                fault_bitmask);
};

} // namespace godwit::io::mavlink
