// How sure the autopilot is of where it is: EKF_STATUS_REPORT (ArduPilot), ESTIMATOR_STATUS (PX4).
// Source: MAVLink's ardupilotmega.xml and common.xml, whose names and order of fields are kept.
#pragma once

#include <cstdint>

#include "io/mavlink/layout.hpp"

namespace godwit::io::mavlink {

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

} // namespace godwit::io::mavlink
