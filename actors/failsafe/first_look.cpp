#include "actors/failsafe/first_look.hpp"

#include <algorithm>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/domain/vehicle_text/vehicle_text.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::failsafe {

void first_look::heard(std::uint32_t message_id) {
  for (auto& each : wanted_)
    if (each.message_id == message_id && --each.needed <= 0)
      each.tries_left = 0;
}

std::optional<std::uint32_t> first_look::next(bool at_tick) {
  if (at_tick)
    for (auto& each : wanted_)
      each.is_asked = false;
  if (asking_)
    return std::nullopt;
  const auto found = std::find_if(wanted_.begin(), wanted_.end(),
                                  [](const wanted_message& each) { return each.tries_left > 0 && !each.is_asked; });
  if (found == wanted_.end())
    return std::nullopt;
  --found->tries_left;
  found->is_asked = true;
  asking_ = true;
  return found->message_id;
}

namespace {

namespace mavlink = io::mavlink;

constexpr double degrees_e7 = 1e-7;
constexpr double metres_from_mm = 1e-3;
constexpr double mps_from_cm = 1e-2;

} // namespace

heartbeat sense(const mavlink::heartbeat& m) {
  const bool armed = io::mavlink::is_armed(m);
  const auto owner = flight::owner_of(m);
  return {owner.vehicle, armed, flight::mode_of(m), owner.autopilot,
          m.system_status == mavlink::number(mavlink::mav_state::critical)};
}

modes_told sense(const mavlink::current_mode& m) { return {m.custom_mode, m.intended_custom_mode}; }

autopilot_text sense(const mavlink::statustext& m) { return {std::string(flight::text_of(m))}; }

landed sense(const mavlink::extended_sys_state& m) {
  switch (static_cast<mavlink::mav_landed_state>(m.landed_state)) {
  case mavlink::mav_landed_state::on_ground:
    return {landed_state::on_ground};
  case mavlink::mav_landed_state::in_air:
    return {landed_state::in_air};
  case mavlink::mav_landed_state::takeoff:
    return {landed_state::taking_off};
  case mavlink::mav_landed_state::landing:
    return {landed_state::landing};
  case mavlink::mav_landed_state::undefined:
    break;
  }
  return {landed_state::unknown};
}

position sense(const mavlink::global_position_int& m) {
  return {m.lat * degrees_e7, m.lon * degrees_e7, m.relative_alt * metres_from_mm,
          m.vx * mps_from_cm, m.vy * mps_from_cm, m.vz * mps_from_cm,
          m.time_boot_ms};
}

home_told sense(const mavlink::home_position& m) {
  return {{m.latitude * degrees_e7, m.longitude * degrees_e7, m.altitude * metres_from_mm}};
}

battery sense(const mavlink::sys_status& m) { return {m.battery_remaining}; }

mission_current sense(const mavlink::mission_current& m) {
  return {m.seq, m.mission_state == mavlink::number(mavlink::mission_state::complete)};
}

} // namespace godwit::failsafe
