#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"

#include <cmath>

#include "io/mavlink/frame_meaning.hpp"
#include "programs/godwit-sim/vehicle/autopilot/home_item.hpp"

namespace godwit::sim {

// ArduPilot answers it with the next HEARTBEAT alone; for a PX4 it is a DO_SET_MODE.
void autopilot::take(mavlink::sender from, const mavlink::set_mode& m) {
  if ((m.base_mode & mavlink::number(mavlink::mav_mode_flag::custom_mode_enabled)) == 0)
    return;
  const auto result = change_mode(find_mode(vehicle_traits().modes, m.custom_mode), m.custom_mode);
  if (vehicle_traits().acknowledges_set_mode)
    acknowledge({.from = from, .command = mavlink::number(mavlink::mav_cmd::do_set_mode)}, result);
}

void autopilot::acknowledge(const role::order& what, answer result) {
  const auto asked_on = outlet::only(with_.out.line_of_event());
  const auto there =
      with_.out.aim(vehicle_traits().acknowledges_where_heard ? with_.out.lines_of(what.from) : asked_on);
  with_.out.send(role::answer_to(what, result));
}

void autopilot::hear_heartbeat(mavlink::sender, const mavlink::heartbeat&) {}

std::uint32_t autopilot::mode_in(const role::order& what) const {
  return std::isfinite(what.param2) && what.param2 >= 0 && what.param2 < 0x1p31F
             ? static_cast<std::uint32_t>(what.param2)
             : UINT32_MAX;
}

void autopilot::enter(const flight_mode& mode) {
  with_.state.intended = &mode;
  if (&mode == state().mode)
    return;
  const auto* left = state().mode;
  with_.state.mode = &mode;
  on_mode_left(*left);
  if (state().beats_at_mode_change)
    static_cast<void>(with_.tells.send(mavlink::heartbeat::message_id, now_.world_ns)); // it is known
  steer();
  on_mode_entered(mode);
}

void autopilot::enter_by_failsafe(mode_kind kind) {
  const auto* before = state().intended;
  enter(kind);
  with_.state.intended = before;
}

void autopilot::arm() {
  if (state().is_armed)
    return;
  const bool moves_home = vehicle_traits().sets_home_when_armed && !state().is_home_fixed && state().has_position &&
                          !craft().is_in_air() && may_move_home();
  if (moves_home && craft().where().where != craft().home()) {
    move_home(craft().where().where);
    static_cast<void>(with_.tells.send(mavlink::home_position::message_id, now_.world_ns)); // it is known
  }
  with_.state.is_armed = true;
  steer();
  on_armed();
}

void autopilot::move_home(const position& where) {
  with_.craft.set_home(where);
  if (vehicle_traits().plan_profile.home)
    with_.plans.set_home(home_item(*vehicle_traits().plan_profile.home, where));
}

void autopilot::disarm() {
  if (!state().is_armed)
    return;
  with_.state.is_armed = false;
  steer();
  on_disarmed();
}

void autopilot::steer() {
  if (!state().is_armed) {
    with_.craft.set_task(task::rest{});
    return;
  }
  switch (state().mode->kind) {
  case mode_kind::manual:
    with_.craft.set_task(task::coast{});
    break;
  case mode_kind::hold:
  case mode_kind::guided:
  case mode_kind::take_off: // until it is told how high
    with_.craft.set_task(task::hold{});
    break;
  case mode_kind::mission:
    with_.craft.set_task(task::follow_mission{});
    break;
  case mode_kind::come_back:
    with_.craft.set_task(task::come_back{});
    break;
  case mode_kind::land:
    with_.craft.set_task(task::land{});
    break;
  }
}

void autopilot::go_to(const position& where) { with_.craft.set_task(task::go{where, speed_mps_}); }

void autopilot::climb_to(double altitude_m) { with_.craft.set_task(task::climb{altitude_m}); }

double autopilot::altitude_in(const role::order& what) const {
  if (!std::isfinite(what.z))
    return craft().where().where.altitude_m;
  const bool is_above_sea = mavlink::altitude_in(what.frame) == mavlink::altitude_kind::above_sea;
  return is_above_sea ? what.z : craft().home().altitude_m + what.z;
}

position autopilot::place_in(const role::order& what) const {
  auto place = craft().where().where;
  if (std::isfinite(what.x) && std::isfinite(what.y) && std::abs(what.x) <= 90 && std::abs(what.y) <= 180) {
    place.latitude_deg = what.x;
    place.longitude_deg = what.y;
  }
  place.altitude_m = altitude_in(what);
  return place;
}

void autopilot::lose_position(bool lost) {
  if (state().has_position != lost)
    return;
  with_.state.has_position = !lost;
  if (!lost)
    return;
  with_.tells.freeze_position(craft().where().where);
  if (state().is_armed && state().mode->needs_position)
    on_position_lost();
}

void autopilot::empty_battery() {
  if (state().is_armed)
    on_battery_empty();
}

void autopilot::restart() {
  with_.craft.restart();
  with_.state.is_armed = false;
  with_.state.mode = with_.state.intended = find_mode(vehicle_traits().modes, vehicle_traits().first_mode);
  with_.state.started_world_ns = now_.world_ns;
  with_.state.is_home_fixed = false;
  owed_message_.reset();
  speed_mps_ = 0;
  on_restart();
}

} // namespace godwit::sim
