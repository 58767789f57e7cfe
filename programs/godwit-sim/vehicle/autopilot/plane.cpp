#include "programs/godwit-sim/vehicle/autopilot/plane.hpp"

#include <algorithm>

namespace godwit::sim {

namespace {

using mavlink::mav_cmd;
using mavlink::mav_severity;

constexpr int lands_at_once = 2; // RTL_AUTOLAND

} // namespace

// -- arming and modes -------------------------------------------------------------------------------

void plane::on_mode_left(const flight_mode& mode) {
  disarms_ns_ = never_ns;
  lands_ns_ = never_ns;
  ardupilot::on_mode_left(mode);
}

void plane::on_mode_entered(const flight_mode& mode) {
  ardupilot::on_mode_entered(mode);
  if (mode.kind == mode_kind::take_off && state().is_armed && !craft().is_in_air())
    take_off_ahead();
  if (mode.kind == mode_kind::come_back && rtl_autoland_ == lands_at_once && landing_sequence())
    lands_ns_ = now().world_ns + lands_after_ns;
}

void plane::take_off_ahead() { climb_to(craft().home().altitude_m + vehicle_traits().body.takeoff_altitude_m); }

void plane::on_armed() {
  say(mav_severity::info, "Throttle armed");
  on_mode_entered(*state().mode);
}

void plane::on_disarmed() {
  say(mav_severity::info, "Throttle disarmed");
  disarms_ns_ = never_ns;
  if (!state().is_in(mode_kind::mission))
    reset_mission();
}

// It flies on by what it knows without satellites.
void plane::on_position_lost() { say(mav_severity::critical, "EKF3 IMU0 stopped aiding"); }

// Whatever its mode says, without power it comes down ahead.
void plane::on_battery_empty() {
  if (!state().is_battery_empty)
    say(mav_severity::critical, "Battery 1 is critical");
  if (craft().is_in_air())
    with().craft.set_task(task::land{});
  else
    disarm();
}

void plane::on_restart() {
  disarms_ns_ = never_ns;
  ardupilot::on_restart();
  check_plan();
}

void plane::on_change(const plans::plan_change& what) {
  ardupilot::on_change(what);
  check_plan();
}

void plane::check_plan() {
  const bool marks_landing = std::ranges::any_of(held_mission().items, [](const mavlink::mission_item_int& each) {
    return each.command == mavlink::number(mav_cmd::do_land_start);
  });
  const bool was_armable = state().is_plan_armable;
  with().state.is_plan_armable = rtl_autoland_ != 0 || !marks_landing;
  if (state().is_plan_armable)
    says_checks_ns_ = never_ns;
  else if (was_armable)
    says_checks_ns_ = now().world_ns + ns_per_s;
}

std::optional<autopilot::refusal> plane::why_not_arm(bool forced) const {
  if (auto refused = ardupilot::why_not_arm(forced))
    return refused;
  if (!forced && !state().is_plan_armable)
    return refusal{answer::failed, mav_severity::critical, "Arm: DO_LAND_START set and RTL_AUTOLAND disabled"};
  return std::nullopt;
}

void plane::on_time() {
  if (now().world_ns >= says_checks_ns_) {
    says_checks_ns_ = now().world_ns + says_checks_each_ns;
    if (!state().is_armed)
      say(mav_severity::critical, "PreArm: DO_LAND_START set and RTL_AUTOLAND disabled");
  }
  if (now().world_ns >= lands_ns_) {
    lands_ns_ = never_ns;
    land_by_plan();
  }
  if (now().world_ns < disarms_ns_)
    return;
  disarms_ns_ = never_ns;
  disarm();
}

// -- the mission ------------------------------------------------------------------------------------

void plane::on_item_begun(int sequence) {
  if (command_of(sequence) == mavlink::number(mav_cmd::nav_return_to_launch))
    enter(mode_kind::come_back);
}

void plane::on_landed() {
  const bool is_in_plan = state().is_in(mode_kind::mission) && phase() == mission_phase::running;
  const auto command = is_in_plan ? command_of(run().current()) : std::uint16_t{0};
  if (state().is_battery_empty)
    disarm();
  else if (command == mavlink::number(mav_cmd::nav_land))
    disarms_ns_ = now().world_ns + disarms_after_ns;
  else if (command == mavlink::number(mav_cmd::nav_vtol_land) || state().is_in(mode_kind::land))
    disarms_ns_ = now().world_ns + disarms_on_rotors_after_ns;
}

void plane::on_completed() {
  say(mav_severity::info, "Mission complete, changing mode to RTL");
  enter(mode_kind::come_back);
}

std::string plane::words_of_reached(int sequence) const {
  return is_waypoint(command_of(sequence)) ? "Reached waypoint #" + std::to_string(sequence) : "";
}

// -- commands ---------------------------------------------------------------------------------------

autopilot::answer plane::take_off(const role::order&) { return answer::failed; } // of its vertical motors alone

autopilot::answer plane::pause_or_continue(const role::order&) { return answer::unsupported; }

std::optional<int> plane::landing_sequence() const {
  const auto items = run().items();
  const auto found = std::find_if(items.begin(), items.end(), [](const mavlink::mission_item_int& each) {
    return each.command == mavlink::number(mav_cmd::do_land_start);
  });
  return found == items.end() ? std::nullopt : std::optional(static_cast<int>(found - items.begin()));
}

bool plane::land_by_plan() {
  const auto start = landing_sequence();
  if (!start || !choose(*start))
    return false;
  const auto& mode = mode_of_kind(vehicle_traits().modes, mode_kind::mission);
  const bool is_changed = change_mode(&mode, mode.custom) == answer::accepted;
  if (is_changed)
    say(mav_severity::info, "Landing sequence start");
  return is_changed;
}

autopilot::answer plane::start_landing(const role::order&) {
  return land_by_plan() ? answer::accepted : answer::failed;
}

} // namespace godwit::sim
