// What a vehicle reports of itself beside its position: battery, estimator, fence, radio. Source: common.xml,
// ardupilotmega.xml. Thread: plain values.
#pragma once

#include <array>
#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

// BATTERY_STATUS. Source: MAVLink's common.xml, whose names and order of fields are kept.
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

// How sure the autopilot is of where it is: EKF_STATUS_REPORT (ArduPilot), ESTIMATOR_STATUS (PX4).
// Source: MAVLink's ardupilotmega.xml and common.xml, whose names and order of fields are kept.

// It knows where on the earth it is; the same bit in EKF_STATUS_FLAGS and ESTIMATOR_STATUS_FLAGS.
inline constexpr std::uint16_t estimator_pos_horiz_abs = 0x10;

struct ekf_status_report {
  std::uint16_t flags = 0;
  float velocity_variance = 0;
  float pos_horiz_variance = 0;
  float pos_vert_variance = 0;
  float compass_variance = 0;
  float terrain_alt_variance = 0;
  float airspeed_variance = 0;

  static constexpr std::uint32_t message_id = 193;
  static constexpr std::uint8_t crc_extra = 71;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(ekf_status_report, "EKF_STATUS_REPORT", flags, velocity_variance, pos_horiz_variance, pos_vert_variance,
                compass_variance, terrain_alt_variance, airspeed_variance);
};

struct estimator_status {
  std::uint64_t time_usec = 0;
  std::uint16_t flags = 0;
  float vel_ratio = 0;
  float pos_horiz_ratio = 0;
  float pos_vert_ratio = 0;
  float mag_ratio = 0;
  float hagl_ratio = 0;
  float tas_ratio = 0;
  float pos_horiz_accuracy = 0; // m
  float pos_vert_accuracy = 0;  // m

  static constexpr std::uint32_t message_id = 230;
  static constexpr std::uint8_t crc_extra = 163;
  GODWIT_FIELDS(estimator_status, "ESTIMATOR_STATUS", time_usec, flags, vel_ratio, pos_horiz_ratio, pos_vert_ratio,
                mag_ratio, hagl_ratio, tas_ratio, pos_horiz_accuracy, pos_vert_accuracy);
};

// FENCE_STATUS. Source: MAVLink's common.xml, whose names and order of fields are kept.
struct fence_status {
  std::uint8_t breach_status = 0; // 1 outside
  std::uint16_t breach_count = 0;
  std::uint8_t breach_type = 0;
  std::uint32_t breach_time = 0; // ms since boot
  std::uint8_t breach_mitigation = 0;

  static constexpr std::uint32_t message_id = 162;
  static constexpr std::uint8_t crc_extra = 189;
  static constexpr std::size_t extensions = 1;
  GODWIT_FIELDS(fence_status, "FENCE_STATUS", breach_status, breach_count, breach_type, breach_time, breach_mitigation);
};

// RADIO_STATUS. Source: MAVLink's common.xml, whose names and order of fields are kept.

// From a telemetry radio about itself; radios insert it into the stream without a signature.
struct radio_status {
  std::uint8_t rssi = 0;
  std::uint8_t remrssi = 0;
  std::uint8_t txbuf = 0; // % that is free
  std::uint8_t noise = 0;
  std::uint8_t remnoise = 0;
  std::uint16_t rxerrors = 0;
  std::uint16_t fixed = 0;

  static constexpr std::uint32_t message_id = 109;
  static constexpr std::uint8_t crc_extra = 185;
  GODWIT_FIELDS(radio_status, "RADIO_STATUS", rssi, remrssi, txbuf, noise, remnoise, rxerrors, fixed);
};

} // namespace godwit::io::mavlink
