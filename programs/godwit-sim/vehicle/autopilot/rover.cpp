#include "programs/godwit-sim/vehicle/autopilot/rover.hpp"

#include <cmath>
#include <string>

#include "actors/ground_port/vehicle_role/mission_start.hpp"
#include "programs/godwit-sim/vehicle/autopilot/mission_progress.hpp"

namespace godwit::sim {

namespace {

using mavlink::mav_result;
using mavlink::mav_severity;

constexpr std::string_view no_position = "no position";

} // namespace

// -- arming and modes -------------------------------------------------------------------------------

std::optional<autopilot::refusal> rover::why_not_arm(bool forced) const {
  if (forced)
    return std::nullopt;
  if (!state().has_position)
    return refusal{mav_result::temporarily_rejected, mav_severity::warning, "Arming refused: no position"};
  if (state().is_battery_empty)
    return refusal{mav_result::temporarily_rejected, mav_severity::warning, "Arming refused: battery empty"};
  return std::nullopt;
}

std::optional<autopilot::refusal> rover::why_not_disarm(bool) const { return std::nullopt; } // it stops where it is

autopilot::answer rover::change_mode(const flight_mode* mode, std::uint32_t number) {
  if (mode == nullptr) {
    say(mav_severity::warning, "No such mode " + std::to_string(number));
    return mav_result::denied;
  }
  if (mode->needs_position && !state().has_position) {
    say(mav_severity::warning, std::string(mode->name) + " needs a position");
    return mav_result::temporarily_rejected;
  }
  enter(*mode);
  return mav_result::accepted;
}

void rover::on_disarmed() {
  if (run().state() == run_state::running)
    run().stop();
}

void rover::on_position_lost() {
  say(mav_severity::warning, "Position lost: hold");
  enter(mode_kind::hold);
}

void rover::on_battery_empty() {
  say(mav_severity::critical, "Battery empty: hold");
  enter(mode_kind::hold);
  disarm();
}

void rover::on_mode_entered(const flight_mode& mode) {
  if (mode.kind == mode_kind::mission && run().state() == run_state::completed)
    enter(mode_kind::hold);
}

void rover::on_restart() {
  start_point_.reset();
  run().load(held_mission().items);
}

// -- the mission ------------------------------------------------------------------------------------

autopilot::answer rover::start_mission(const role::order& what) {
  const bool has_chosen = what.param1 == 0 && start_point_.has_value();
  const auto first = has_chosen ? static_cast<float>(*start_point_) : what.param1;
  const std::string_view battery = state().is_battery_empty ? "battery empty" : "";
  const auto decision =
      role::decide_start({first, what.param2}, {.item_count = run().count(),
                                                .is_transferring = with().plans.is_receiving(),
                                                .not_ready = std::string(state().has_position ? battery : no_position),
                                                .is_armed = state().is_armed,
                                                .arms_on_start = arms_on_start_});
  if (decision.result != mav_result::accepted) {
    say(mav_severity::warning, decision.text);
    return decision.result;
  }
  start_point_.reset();
  arm();
  run().forget_jumps();
  run().start(decision.first, decision.last);
  enter(mode_kind::mission);
  say(mav_severity::info, decision.text);
  return mav_result::accepted;
}

bool rover::choose(int sequence) {
  if (run().set_current(sequence)) {
    if (run().state() != run_state::running)
      start_point_ = sequence;
    return true;
  }
  say(mav_severity::warning, "Item " + std::to_string(sequence) + " is not in the mission");
  return false;
}

void rover::take(const mavlink::mission_set_current& m) { static_cast<void>(choose(m.seq)); }

autopilot::answer rover::set_mission_current(const role::order& what) {
  constexpr float keep = -1;
  if (!std::isfinite(what.param1) || std::trunc(what.param1) != what.param1 || std::abs(what.param1) >= 0x1p24F)
    return mav_result::denied;
  const auto sequence = what.param1 == keep ? run().current() : static_cast<int>(what.param1);
  if (run().is_empty())
    return mav_result::failed;
  return choose(sequence) ? mav_result::accepted : mav_result::denied;
}

void rover::on_change(const plans::plan_change& what) {
  if (what.type != mavlink::mav_mission_type::mission)
    return;
  const bool goes_on = what.identical && run().state() == run_state::running;
  if (goes_on)
    return;
  start_point_.reset();
  run().load(held_mission().items);
  if (what.marked_current && run().set_current(*what.marked_current))
    start_point_ = what.marked_current;
}

void rover::on_happening(const happening& what) {
  if (const auto* reached = std::get_if<item_reached>(&what)) {
    with().out.send(mavlink::mission_item_reached{static_cast<std::uint16_t>(reached->sequence)});
  } else if (const auto* skipped = std::get_if<item_skipped>(&what)) {
    say(mav_severity::warning, "Item " + std::to_string(skipped->sequence) + " skipped: " + skipped->reason);
  } else if (std::holds_alternative<mission_completed>(what)) {
    say(mav_severity::info, "Mission completed");
    enter(mode_kind::hold);
  } else if (std::holds_alternative<arrived>(what) && state().is_in(mode_kind::come_back)) {
    enter(mode_kind::hold);
  }
}

mavlink::mission_current rover::progress() const {
  return progress_of(run(), with().plans, vehicle_traits(), state().is_in(mode_kind::mission));
}

// -- commands ---------------------------------------------------------------------------------------

autopilot::answer rover::take_off(const role::order&) { return mav_result::unsupported; }

autopilot::answer rover::reposition(const role::order&) { return mav_result::unsupported; }

autopilot::answer rover::pause_or_continue(const role::order& what) {
  if (run().state() != run_state::running || (what.param1 != 0 && what.param1 != 1))
    return mav_result::denied;
  if (what.param1 == 0) {
    enter(mode_kind::hold);
    return mav_result::accepted;
  }
  const auto& mode = mode_of_kind(vehicle_traits().modes, mode_kind::mission);
  return change_mode(&mode, mode.custom);
}

autopilot::answer rover::restart_or_shut_down(const role::order& what) {
  constexpr float restart_autopilot = 1;
  if (what.param1 != restart_autopilot)
    return mav_result::unsupported;
  if (state().is_armed)
    return mav_result::denied;
  ask_for_restart();
  return mav_result::accepted;
}

void ardu_rover::on_armed() {
  say(mav_severity::info, "Throttle armed");
  on_mode_entered(*state().mode);
}

void ardu_rover::on_disarmed() {
  say(mav_severity::info, "Throttle disarmed");
  if (state().is_in(mode_kind::mission))
    on_mode_left(*state().mode);
}

void ardu_rover::on_position_lost() {
  say(mav_severity::critical, "EKF failsafe");
  enter(mode_kind::hold);
}

void ardu_rover::on_battery_empty() {
  say(mav_severity::critical, "Battery 1 is critical");
  enter(mode_kind::hold);
}

// FENCE_ACTION 1, and no word of it (Rover/fence.cpp).
void ardu_rover::breach_fence() {
  if (state().is_armed)
    enter(mode_kind::come_back);
}

void ardu_rover::on_completed() { say(mav_severity::notice, "Mission Complete"); }

std::string ardu_rover::words_of_reached(int sequence) const {
  return is_waypoint(command_of(sequence)) ? "Reached waypoint #" + std::to_string(sequence) : "";
}

} // namespace godwit::sim
