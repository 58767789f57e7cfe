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
  static constexpr auto fields = table("EKF_STATUS_REPORT", field("flags", &ekf_status_report::flags),
                                       field("velocity_variance", &ekf_status_report::velocity_variance),
                                       field("pos_horiz_variance", &ekf_status_report::pos_horiz_variance),
                                       field("pos_vert_variance", &ekf_status_report::pos_vert_variance),
                                       field("compass_variance", &ekf_status_report::compass_variance),
                                       field("terrain_alt_variance", &ekf_status_report::terrain_alt_variance),
                                       field("airspeed_variance", &ekf_status_report::airspeed_variance));
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
  static constexpr auto fields = table(
      "ESTIMATOR_STATUS", field("time_usec", &estimator_status::time_usec), field("flags", &estimator_status::flags),
      field("vel_ratio", &estimator_status::vel_ratio), field("pos_horiz_ratio", &estimator_status::pos_horiz_ratio),
      field("pos_vert_ratio", &estimator_status::pos_vert_ratio), field("mag_ratio", &estimator_status::mag_ratio),
      field("hagl_ratio", &estimator_status::hagl_ratio), field("tas_ratio", &estimator_status::tas_ratio),
      field("pos_horiz_accuracy", &estimator_status::pos_horiz_accuracy),
      field("pos_vert_accuracy", &estimator_status::pos_vert_accuracy));
};

} // namespace godwit::io::mavlink
