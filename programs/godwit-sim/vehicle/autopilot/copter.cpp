#include "programs/godwit-sim/vehicle/autopilot/copter.hpp"

#include <algorithm>

namespace godwit::sim {

namespace {

using mavlink::mav_cmd;
using mavlink::mav_severity;

} // namespace

// -- arming and modes -------------------------------------------------------------------------------

bool copter::is_armable(mode_kind kind) const {
  return kind != mode_kind::mission && kind != mode_kind::come_back && kind != mode_kind::land;
}

std::string_view copter::why_not_auto() const {
  return craft().is_in_air() || begins_with_take_off() ? "" : "Auto: Missing Takeoff Cmd";
}

bool copter::begins_with_take_off() const {
  const auto items = run().items();
  const auto found = std::find_if(items.begin() + std::min<std::ptrdiff_t>(first_flown, std::ssize(items)), items.end(),
                                  [](const mavlink::mission_item_int& each) { return is_nav(each); });
  return found != items.end() && found->command == mavlink::number(mav_cmd::nav_takeoff);
}

void copter::on_armed() { preflight_ends_ns_ = now().world_after(disarms_after_ns); }

void copter::on_disarmed() {
  preflight_ends_ns_ = never_ns;
  is_auto_armed_ = false;
  reset_mission();
}

void copter::on_position_lost() {
  say(mav_severity::critical, "EKF Failsafe: changed to LAND Mode");
  enter(mode_kind::land);
}

void copter::on_battery_empty() {
  say(mav_severity::critical, "Battery 1 is critical");
  if (craft().is_in_air())
    enter(mode_kind::land);
  else
    disarm();
}

// Nobody gives throttle there.
void copter::on_mode_entered(const flight_mode& mode) {
  is_auto_armed_ = is_auto_armed_ && mode.kind != mode_kind::manual;
  ardupilot::on_mode_entered(mode);
}

void copter::on_restart() {
  preflight_ends_ns_ = never_ns;
  is_auto_armed_ = false;
  ardupilot::on_restart();
}

void copter::on_time() {
  if (now().world_ns < preflight_ends_ns_)
    return;
  preflight_ends_ns_ = never_ns; // also for who was armed again in the air
  if (!craft().is_in_air())
    disarm();
}

// -- the mission ------------------------------------------------------------------------------------

// After a landing that ends the plan it disarms, sets the mission back and takes it for running: no word that it was
// done.
void copter::on_landed() {
  const bool goes_on = state().is_in(mode_kind::mission) && phase() == mission_phase::running;
  const bool is_last = run().current() + 1 == run().count();
  if (!goes_on) {
    disarm();
  } else if (is_last && run().items().back().command == mavlink::number(mav_cmd::nav_land)) {
    disarm();
    set_back_and_running();
  }
}

void copter::on_completed() {
  say(mav_severity::notice, "Mission Complete");
  if (!craft().is_in_air())
    disarm();
}

std::string copter::words_of_reached(int sequence) const {
  return is_waypoint(command_of(sequence)) ? "Reached command #" + std::to_string(sequence) : "";
}

// -- commands ---------------------------------------------------------------------------------------

autopilot::answer copter::start_mission(const role::order& what) {
  const auto result = ardupilot::start_mission(what);
  is_auto_armed_ = is_auto_armed_ || (state().is_armed && result == answer::accepted);
  return result;
}

autopilot::answer copter::take_off(const role::order& what) {
  if (!state().is_in(mode_kind::guided) || !state().is_armed || craft().is_in_air() || !(what.z > 0))
    return answer::failed;
  climb_to(altitude_in(what));
  return answer::accepted;
}

// In AUTO it stays where it is, without leaving the mode.
autopilot::answer copter::pause_or_continue(const role::order& what) {
  const bool can = flies_mission() && craft().is_in_air();
  if (!can || (what.param1 != 0 && what.param1 != 1))
    return answer::unsupported;
  if (what.param1 == 0)
    hold_here();
  else
    steer();
  return answer::accepted;
}

} // namespace godwit::sim
