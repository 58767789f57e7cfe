#include "programs/godwit-sim/vehicle/autopilot/telemetry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/mavlink/messages/heartbeat.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim {

namespace {

// The world begins on 2026-01-01 UTC: a pure vehicle has no calendar, and ground stations want a plausible one.
constexpr std::int64_t world_begin_us = 1'767'225'600'000'000;
constexpr std::uint16_t no_cell = 65535;
constexpr std::int16_t no_temperature = 32767;

std::uint32_t ms(std::int64_t ns) { return static_cast<std::uint32_t>(ns / ns_per_ms); }
std::uint64_t us(std::int64_t ns) { return static_cast<std::uint64_t>(ns / 1'000); }
std::int32_t mm(double metres) { return static_cast<std::int32_t>(std::lround(metres * 1e3)); }
std::int16_t cm(double metres) { return static_cast<std::int16_t>(std::lround(metres * 1e2)); }
std::uint16_t centidegrees(double degrees) {
  return static_cast<std::uint16_t>(std::lround(degrees * 1e2) % 36'000); // 360.00 is 0
}
double radians(double degrees) { return degrees * std::numbers::pi / 180; }
// -pi to pi, as in ATTITUDE.
double yaw(double heading_deg) { return radians(heading_deg > 180 ? heading_deg - 360 : heading_deg); }

} // namespace

bool telemetry::knows(std::uint32_t id) const {
  static constexpr std::array<std::uint32_t, 13> known{mavlink::heartbeat::message_id,
                                                       mavlink::sys_status::message_id,
                                                       mavlink::system_time::message_id,
                                                       mavlink::gps_raw_int::message_id,
                                                       mavlink::attitude::message_id,
                                                       mavlink::vfr_hud::message_id,
                                                       mavlink::global_position_int::message_id,
                                                       mavlink::battery_status::message_id,
                                                       mavlink::home_position::message_id,
                                                       mavlink::extended_sys_state::message_id,
                                                       mavlink::autopilot_version::message_id,
                                                       mavlink::ping::message_id,
                                                       mavlink::timesync::message_id};
  if (id == mavlink::protocol_version::message_id)
    return traits_.tells_protocol_version;
  if (id == mavlink::current_mode::message_id)
    return traits_.tells_intended_mode;
  if (id == mavlink::ekf_status_report::message_id)
    return traits_.autopilot == mavlink::mav_autopilot::ardupilotmega;
  if (id == mavlink::estimator_status::message_id)
    return traits_.autopilot == mavlink::mav_autopilot::px4;
  return std::find(known.begin(), known.end(), id) != known.end();
}

bool telemetry::send(std::uint32_t id, std::int64_t world_ns) {
  if (!knows(id))
    return false;
  const auto up_ns = state_.up_ns(world_ns);
  switch (id) {
  case mavlink::heartbeat::message_id:
    out_.send(beat());
    return true;
  case mavlink::current_mode::message_id:
    out_.send(
        mavlink::current_mode{.custom_mode = state_.mode->custom, .intended_custom_mode = state_.intended->custom});
    return true;
  case mavlink::sys_status::message_id:
    out_.send(status());
    return true;
  case mavlink::system_time::message_id:
    out_.send(mavlink::system_time{static_cast<std::uint64_t>(world_begin_us + world_ns / 1'000), ms(up_ns)});
    return true;
  case mavlink::gps_raw_int::message_id:
    out_.send(satellites(up_ns));
    return true;
  case mavlink::global_position_int::message_id:
    if (state_.has_position || traits_.tells_stale_position)
      out_.send(place(up_ns));
    return true;
  case mavlink::attitude::message_id:
    out_.send(angles(up_ns));
    return true;
  case mavlink::vfr_hud::message_id:
    out_.send(hud());
    return true;
  case mavlink::battery_status::message_id:
    out_.send(charge());
    return true;
  case mavlink::home_position::message_id:
    out_.send(home(up_ns));
    return true;
  case mavlink::extended_sys_state::message_id:
    out_.send(mavlink::extended_sys_state{.vtol_state = craft_.vtol_state(),
                                          .landed_state = mavlink::number(landed_state())});
    return true;
  case mavlink::ekf_status_report::message_id:
    out_.send(mavlink::ekf_status_report{.flags = estimator_flags()});
    return true;
  case mavlink::estimator_status::message_id:
    out_.send(mavlink::estimator_status{.time_usec = us(up_ns), .flags = estimator_flags()});
    return true;
  case mavlink::autopilot_version::message_id:
    out_.send(version());
    return true;
  case mavlink::protocol_version::message_id:
    out_.send(mavlink::protocol_version{.version = 200, .min_version = 100, .max_version = 203});
    return true;
  case mavlink::ping::message_id:
    out_.send(mavlink::ping{.time_usec = us(up_ns), .seq = pings_++});
    return true;
  case mavlink::timesync::message_id:
    out_.send(mavlink::timesync{.tc1 = 0, .ts1 = up_ns + 1}); // 0 would be no time
    return true;
  default:
    GODWIT_ASSERT(false, "each message that is known can be made");
  }
}

mavlink::heartbeat telemetry::beat() const {
  mavlink::heartbeat m{.type = mavlink::number(traits_.type),
                       .autopilot = mavlink::number(traits_.autopilot),
                       .base_mode = state_.mode->base,
                       .custom_mode = state_.mode->custom};
  if (state_.is_armed)
    m.base_mode |= mavlink::number(mavlink::mav_mode_flag::safety_armed);
  // ArduPilot's vehicles call themselves active in the air alone, the others as soon as they are armed.
  const bool is_ardupilot = traits_.autopilot == mavlink::mav_autopilot::ardupilotmega;
  const bool is_active = is_ardupilot ? craft_.is_in_air() : state_.is_armed;
  auto how = is_active ? mavlink::mav_state::active : mavlink::mav_state::standby;
  if (is_active && (state_.is_battery_empty || !state_.has_position))
    how = mavlink::mav_state::critical;
  if (state_.is_booting)
    how = is_ardupilot ? mavlink::mav_state::boot : mavlink::mav_state::uninit;
  m.system_status = mavlink::number(how);
  return m;
}

mavlink::sys_status telemetry::status() const {
  auto health = traits_.sensors.health;
  if (!state_.has_position)
    health &= ~gps_bit;
  if (!state_.has_position || !state_.is_ready || state_.is_battery_empty || !state_.is_plan_armable)
    health &= ~prearm_bit;
  return {.onboard_control_sensors_present = traits_.sensors.present,
          .onboard_control_sensors_enabled = traits_.sensors.enabled,
          .onboard_control_sensors_health = health,
          .load = 80,
          .voltage_battery = static_cast<std::uint16_t>(std::lround(power_.voltage_v() * 1e3)),
          .current_battery = static_cast<std::int16_t>(std::lround(power_.current_a() * 1e2)),
          .battery_remaining = static_cast<std::int8_t>(std::lround(power_.percent()))};
}

mavlink::gps_raw_int telemetry::satellites(std::int64_t up_ns) const {
  const auto& now = craft_.where();
  mavlink::gps_raw_int m{.time_usec = us(up_ns),
                         .fix_type = mavlink::number(mavlink::gps_fix_type::no_fix),
                         .eph = no_cell,
                         .epv = no_cell,
                         .vel = no_cell,
                         .cog = no_cell};
  if (!state_.has_position)
    return m;
  m.fix_type = traits_.fix_type;
  m.lat = e7(now.where.latitude_deg);
  m.lon = e7(now.where.longitude_deg);
  m.alt = mm(now.where.altitude_m);
  m.alt_ellipsoid = m.alt;
  m.eph = 70;
  m.epv = 110;
  m.vel = static_cast<std::uint16_t>(cm(now.ground_speed_mps));
  m.cog = centidegrees(now.track_deg);
  m.satellites_visible = 10;
  m.h_acc = 900;
  m.v_acc = 1780;
  m.vel_acc = 400;
  return m;
}

mavlink::global_position_int telemetry::place(std::int64_t up_ns) const {
  const auto& now = craft_.where();
  const auto& where = state_.has_position ? now.where : frozen_;
  const auto track = radians(now.track_deg);
  return {.time_boot_ms = ms(up_ns),
          .lat = e7(where.latitude_deg),
          .lon = e7(where.longitude_deg),
          .alt = mm(now.where.altitude_m),
          .relative_alt = mm(craft_.altitude_above_home_m()),
          .vx = cm(now.ground_speed_mps * std::cos(track)),
          .vy = cm(now.ground_speed_mps * std::sin(track)),
          .vz = cm(-now.climb_mps),
          .hdg = centidegrees(now.heading_deg)};
}

mavlink::attitude telemetry::angles(std::int64_t up_ns) const {
  const auto& now = craft_.where();
  return {.time_boot_ms = ms(up_ns),
          .roll = static_cast<float>(now.roll_rad),
          .pitch = static_cast<float>(now.pitch_rad),
          .yaw = static_cast<float>(yaw(now.heading_deg)),
          .yawspeed = static_cast<float>(now.turn_rate_rad_s)};
}

mavlink::vfr_hud telemetry::hud() const {
  const auto& now = craft_.where();
  return {.airspeed = static_cast<float>(now.ground_speed_mps), // there is no wind
          .groundspeed = static_cast<float>(now.ground_speed_mps),
          .heading = static_cast<std::int16_t>(std::lround(now.heading_deg) % 360),
          .throttle = static_cast<std::uint16_t>(std::lround(now.throttle * 100)),
          .alt = static_cast<float>(now.where.altitude_m),
          .climb = static_cast<float>(now.climb_mps)};
}

mavlink::battery_status telemetry::charge() const {
  mavlink::battery_status m{.temperature = no_temperature,
                            .current_battery = static_cast<std::int16_t>(std::lround(power_.current_a() * 1e2)),
                            .current_consumed = static_cast<std::int32_t>(std::lround(power_.consumed_mah())),
                            .energy_consumed = -1,
                            .battery_remaining = static_cast<std::int8_t>(std::lround(power_.percent())),
                            .charge_state = 1}; // ok
  m.voltages.fill(no_cell);
  m.voltages[0] = static_cast<std::uint16_t>(std::lround(power_.voltage_v() * 1e3)); // all cells together
  return m;
}

mavlink::home_position telemetry::home(std::int64_t up_ns) const {
  const auto& where = craft_.home();
  mavlink::home_position m{.latitude = e7(where.latitude_deg),
                           .longitude = e7(where.longitude_deg),
                           .altitude = mm(where.altitude_m),
                           .q = {1, 0, 0, 0},
                           .time_usec = us(up_ns)};
  if (traits_.autopilot == mavlink::mav_autopilot::ardupilotmega) { // it does not know them
    m.x = m.y = m.z = std::numeric_limits<float>::quiet_NaN();
    m.q.fill(std::numeric_limits<float>::quiet_NaN());
  }
  return m;
}

mavlink::autopilot_version telemetry::version() const {
  auto m = traits_.version;
  m.uid = 0x676f'6477'6974'0000U + out_.ourselves().system; // each vehicle has its own
  return m;
}

mavlink::mav_landed_state telemetry::landed_state() const {
  if (!craft_.is_in_air()) // a rover too: it is on the ground
    return mavlink::mav_landed_state::on_ground;
  return is_landing() ? mavlink::mav_landed_state::landing : mavlink::mav_landed_state::in_air;
}

// As recorded without and with a position.
std::uint16_t telemetry::estimator_flags() const {
  constexpr std::uint16_t without = 0x00A7; // attitude, speeds and height, and it assumes to stand still
  constexpr std::uint16_t with = 0x032F | mavlink::estimator_pos_horiz_abs;
  return state_.has_estimate ? with : without;
}

bool telemetry::is_landing() const {
  if (std::holds_alternative<task::land>(craft_.current_task()))
    return true;
  const bool descends = craft_.where().climb_mps < -0.1 && craft_.where().ground_speed_mps < 0.5;
  if (std::holds_alternative<task::come_back>(craft_.current_task()))
    return descends;
  const auto* item = craft_.mission().item();
  return std::holds_alternative<task::follow_mission>(craft_.current_task()) && item != nullptr && descends &&
         (item->command == mavlink::number(mavlink::mav_cmd::nav_land) ||
          item->command == mavlink::number(mavlink::mav_cmd::nav_return_to_launch));
}

} // namespace godwit::sim
