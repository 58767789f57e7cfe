#include "actors/vehicle_link/settings.hpp"

namespace godwit::vehicle_link {

std::vector<wanted_stream> default_streams() {
  return {{mavlink::global_position_int::message_id, 200},
          {mavlink::attitude::message_id, 200},
          {mavlink::sys_status::message_id, 1'000},
          {mavlink::gps_raw_int::message_id, 1'000},
          {mavlink::mission_current::message_id, 200},
          {mavlink::extended_sys_state::message_id, 1'000},
          {mavlink::battery_status::message_id, 2'000},
          {mavlink::home_position::message_id, 2'000}, // somebody may move it
          {mavlink::ekf_status_report::message_id, 1'000, mavlink::mav_autopilot::ardupilotmega},
          {mavlink::estimator_status::message_id, 1'000, mavlink::mav_autopilot::px4},
          {mavlink::current_mode::message_id, 500, mavlink::mav_autopilot::px4, true},
          // One aircraft a message; a PX4 sends them by itself.
          {mavlink::adsb_vehicle::message_id, 200, mavlink::mav_autopilot::ardupilotmega, true, true}};
}

std::vector<wanted_stream> streams_for_stations() {
  auto result = default_streams();
  for (auto& each : result)
    if (each.message == mavlink::battery_status::message_id)
      each.interval_ms = 1'000;
  result.push_back({mavlink::vfr_hud::message_id, 250, {}, true});
  return result;
}

} // namespace godwit::vehicle_link
