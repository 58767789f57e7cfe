#include "programs/godwit-sim/vehicle/autopilot/px4.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "io/mavlink/messages/heartbeat.hpp"
#include "programs/godwit-sim/vehicle/autopilot/mission_progress.hpp"
#include "programs/godwit-sim/vehicle/flight/item_place.hpp"
#include "programs/godwit-sim/vehicle/flight/mission_run.hpp"

namespace godwit::sim {

namespace {

using mavlink::mav_severity;

constexpr double default_takeoff_m = 2.5; // MIS_TAKEOFF_ALT
constexpr std::string_view health_failure = "Arming denied: Resolve system health failures first\t";

} // namespace

px4::px4(const equipment& tools, bool holds_when_landed, bool has_sticks)
    : autopilot(tools), holds_when_landed_(holds_when_landed), has_sticks_(has_sticks) {
  with().out.hold_texts_back(true);
}

// -- arming and modes -------------------------------------------------------------------------------

std::optional<autopilot::refusal> px4::why_not_arm(bool forced) const {
  if (!forced && (!state().has_position || state().is_battery_empty))
    return refusal{answer::temporarily_rejected, mav_severity::critical, health_failure};
  return std::nullopt;
}

std::optional<autopilot::refusal> px4::why_not_disarm(bool forced) const {
  if (!forced && craft().is_in_air())
    return refusal{answer::temporarily_rejected, mav_severity::critical, "Disarming denied: not landed\t"};
  return std::nullopt;
}

std::uint32_t px4::mode_in(const role::order& what) const {
  const auto is_part = [](float value) { return value >= 0 && value <= 255; };
  if (!is_part(what.param2) || !is_part(what.param3))
    return UINT32_MAX;
  return px4_mode(static_cast<std::uint32_t>(what.param2), static_cast<std::uint32_t>(what.param3));
}

// It answers twice: once for having heard it (MavlinkReceiver::handle_message_command_both), and then Commander does.
void px4::on_mode_commanded(const role::order& what) { acknowledge(what, answer::accepted); }

autopilot::answer px4::change_mode(const flight_mode* mode, std::uint32_t) {
  if (mode == nullptr)
    return answer::accepted;
  const bool has_no_mission = mode->kind == mode_kind::mission && (run().is_empty() || is_infeasible_);
  const bool has_no_position = mode->needs_position && !state().has_position;
  const bool has_no_sticks = mode->kind == mode_kind::manual && !has_sticks_;
  if (state().is_armed && (has_no_mission || has_no_position || has_no_sticks)) {
    say_tabbed(mav_severity::critical, "Switching to mode '" + std::string(mode->name) + "' is currently not possible");
    return answer::temporarily_rejected;
  }
  if (mode->kind == mode_kind::take_off)
    takeoff_altitude_m_ = craft().home().altitude_m + default_takeoff_m;
  enter(*mode);
  return answer::accepted;
}

void px4::on_mode_entered(const flight_mode& mode) {
  if (!state().is_armed)
    return;
  if (mode.kind == mode_kind::mission)
    begin_mission();
  else if (mode.kind == mode_kind::take_off)
    climb_to(takeoff_altitude_m_);
}

// In the middle of a mission it stays where it was.
bool px4::may_move_home() const {
  return run().is_empty() || run().current() == 0 || run().state() == run_state::completed;
}

void px4::on_armed() {
  say_tabbed(mav_severity::info, "Armed by " + std::string(reason_));
  preflight_ends_ns_ = now().world_after(disarms_after_ns);
  on_mode_entered(*state().mode);
}

void px4::on_disarmed() {
  say_tabbed(mav_severity::info, "Disarmed by " + std::string(reason_));
  preflight_ends_ns_ = never_ns;
  const auto kind = state().mode->kind;
  const bool is_finished = run().state() == run_state::completed || run().current() + 1 == run().count();
  if (run().state() == run_state::running)
    run().stop();
  if (!run().is_empty() && (kind == mode_kind::land || kind == mode_kind::come_back)) // by itself
    enter(is_finished ? mode_kind::hold : mode_kind::mission);
}

void px4::disarm_by(std::string_view reason) {
  reason_ = reason;
  disarm();
  reason_ = by_command;
}

void px4::on_position_lost() {
  say_tabbed(mav_severity::critical, "Failsafe activated");
  enter_by_failsafe(mode_kind::land);
}

void px4::on_battery_empty() {
  say_tabbed(mav_severity::emergency, "Emergency battery level, land immediately");
  if (craft().is_in_air())
    enter_by_failsafe(mode_kind::land);
  else
    disarm();
}

void px4::on_restart() {
  run().load(held_mission().items);
  check_plan();
  reached_ = {};
  stale_messages_ = {};
  unchecked_until_ns_ = now().world_after(checks_after_restart_ns);
  sticks_.forget();
  heard_station_ns_ = -1;
  preflight_ends_ns_ = never_ns;
  trigger_again_ns_ = never_ns;
  holds_at_ns_ = disarms_at_ns_ = never_ns;
  with().out.hold_texts_back(true);
}

void px4::hear_heartbeat(mavlink::sender, const mavlink::heartbeat& m) {
  if (m.type != mavlink::number(mavlink::mav_type::gcs))
    return;
  with().out.hold_texts_back(with().out.line_of_event(), false);
  if (heard_station_ns_ >= 0 && now().real_ns - heard_station_ns_ > station_lost_after_ns)
    say_tabbed(mav_severity::info, "GCS connection regained");
  heard_station_ns_ = now().real_ns;
}

// -- the mission ------------------------------------------------------------------------------------

autopilot::answer px4::start_mission(const role::order& what) {
  if (run().is_empty() || is_infeasible_) {
    say_tabbed(mav_severity::critical, "Mission start denied! No valid mission");
    return answer::denied;
  }
  constexpr float where_it_is = -1;
  const bool is_first = what.param1 >= where_it_is && what.param1 < static_cast<float>(run().count());
  const bool ends_before_it_begins = what.param2 > 0 && what.param2 < what.param1;
  if (!is_first || ends_before_it_begins)
    return answer::denied;
  if (!state().has_position || (!state().is_armed && why_not_arm(false))) {
    say_tabbed(mav_severity::critical, "Mission start denied! Resolve system health failures first");
    return answer::temporarily_rejected;
  }
  if (what.param1 >= 0)
    static_cast<void>(run().set_current(static_cast<int>(what.param1))); // is one, see above
  enter(mode_kind::mission);
  reason_ = "mission start";
  arm();
  reason_ = by_command;
  if (run().state() != run_state::running)
    begin_mission();
  return answer::accepted;
}

void px4::begin_mission() {
  says_complete_ = false;
  if (run().is_empty()) {
    say_tabbed(mav_severity::info, "No valid mission available, loitering");
    enter(mode_kind::hold);
    return;
  }
  if (run().state() == run_state::completed) {
    if (craft().is_in_air())
      return refuse_finished_mission();
    run().start(0);
  } else if (run().state() == run_state::idle) {
    run().start(run().current());
  }
  announce_mission();
}

// After the return of a mission, too: it is finished as that begins. A vehicle that gets another item meanwhile goes
// there.
void px4::refuse_finished_mission() {
  say_tabbed(mav_severity::critical, "No valid mission available, loitering");
  holds_at_ns_ = now().world_ns + holds_after_ns;
}

// Its return is a mode, and the end of the mission: the item is reached and the mission complete as it begins.
void px4::begin_return(int sequence) {
  with().out.send(mavlink::command_long{.target_system = with().out.ourselves().system,
                                        .command = mavlink::number(mavlink::mav_cmd::nav_return_to_launch)});
  with().out.send(mavlink::mission_item_reached{static_cast<std::uint16_t>(sequence)});
  reached_.forget();
  run().advance();
  stop_trigger(0);
  trigger_again_ns_ = now().world_ns + ns_per_s;
  enter(mode_kind::come_back);
}

void px4::announce_mission() {
  say_tabbed(mav_severity::info, "Executing Mission");
  const auto* item = run().item();
  if (craft().is_in_air() || item == nullptr || item->command != mavlink::number(mavlink::mav_cmd::nav_takeoff))
    return;
  std::array<char, 50> text{};
  std::snprintf(text.data(), text.size(), "Climb to %.1f meters above home\t", static_cast<double>(item->z));
  say(mav_severity::info, text.data());
}

void px4::finish_mission() {
  stop_trigger(0);
  trigger_again_ns_ = now().world_ns + ns_per_s;
  if (craft().is_in_air()) {
    say_tabbed(mav_severity::info, "Mission finished, loitering");
    enter(mode_kind::hold);
  } else {
    say_tabbed(mav_severity::info, "Mission finished, landed");
    finish_on_ground();
  }
}

// Seen of a VTOL: one CURRENT_MODE with HOLD, and MISSION as the intended mode, in the millisecond of MISSION_CURRENT
// with state 5; 0.17 s later it is disarmed, and in MISSION again.
void px4::finish_on_ground() {
  if (!holds_when_landed_)
    return disarm_by("landing");
  enter_by_failsafe(mode_kind::hold);
  static_cast<void>(with().tells.send(mavlink::current_mode::message_id, now().world_ns)); // it is known
  disarms_at_ns_ = now().world_ns + disarms_after_hold_ns;
}

// A camera may still be triggered along the way; whoever has one is to stop.
void px4::stop_trigger(std::uint8_t confirmation) {
  with().out.send(mavlink::command_long{.target_system = with().out.ourselves().system,
                                        .command = mavlink::number(mavlink::mav_cmd::do_trigger_control),
                                        .confirmation = confirmation,
                                        .param1 = -1,
                                        .param3 = 1});
}

void px4::take(const mavlink::mission_set_current& m) {
  if (!with().plans.is_idle())
    say_tabbed(mav_severity::critical, "WPM: IGN WP CURR CMD: Busy");
  else if (!run().set_current(m.seq))
    say_tabbed(mav_severity::critical, "WPM: WP CURR CMD: Not in list");
  else if (state().is_armed && state().is_in(mode_kind::mission) && run().state() != run_state::running)
    begin_mission();
}

void px4::on_change(const plans::plan_change& what) {
  if (what.type != mavlink::mav_mission_type::mission)
    return;
  if (what.kind == plans::plan_change_kind::cleared) {
    reached_ = {};
    is_infeasible_ = false;
    run().load({});
    if (state().is_armed && state().is_in(mode_kind::mission))
      enter(mode_kind::hold);
  } else if (!what.identical) {
    take_plan(what);
  }
}

void px4::take_plan(const plans::plan_change& what) {
  unchecked_until_ns_ = 0;
  says_complete_ = false;
  const bool had_plan = !run().is_empty();
  const int old_current = run().current();
  const bool was_completed = run().state() == run_state::completed;
  const int current = what.marked_current.value_or(was_completed ? 0 : old_current);
  run().replace(held_mission().items, 0, current);
  run().forget_jumps();
  check_plan();
  if (is_infeasible_) {
    run().stop();
    if (state().is_armed && state().is_in(mode_kind::mission))
      refuse_finished_mission();
  } else if (was_completed && state().is_armed && state().is_in(mode_kind::mission))
    begin_mission();
  if (!had_plan)
    return;
  if (const auto news = stale_messages_.on_switch({old_current, reached_.last()}, progress(), with().random))
    std::visit([this](const auto& m) { with().out.send(m); }, *news);
  reached_ = {};
}

void px4::check_plan() {
  is_infeasible_ = false;
  const auto& items = held_mission().items;
  for (std::size_t i = 0; i < items.size() && !is_infeasible_ && max_distance_m_ > 0; ++i) {
    const auto place = place_of(items[i], craft().home(), craft().where().where);
    const bool has_place = is_nav(items[i]) && items[i].x != 0 && place && !place->is_here;
    is_infeasible_ = has_place && between(craft().home(), place->at).distance_m > max_distance_m_;
    if (is_infeasible_)
      say_tabbed(mav_severity::critical, "Geofence violation for waypoint " + std::to_string(i + 1));
  }
}

void px4::end_turn() {
  if (const auto news = stale_messages_.take_late())
    std::visit([this](const auto& m) { with().out.send(m); }, *news);
}

void px4::on_happening(const happening& what) {
  if (const auto* begun = std::get_if<item_begun>(&what)) {
    const auto& item = run().items()[static_cast<std::size_t>(begun->sequence)];
    if (item.command == mavlink::number(mavlink::mav_cmd::nav_return_to_launch))
      begin_return(begun->sequence);
  } else if (const auto* reached = std::get_if<item_reached>(&what)) {
    with().out.send(mavlink::mission_item_reached{static_cast<std::uint16_t>(reached->sequence)});
    reached_.reach(reached->sequence, now().world_ns);
  } else if (std::holds_alternative<pictured>(what) && state().has_payload) {
    const auto& at = craft().where().where;
    with().out.send(mavlink::camera_image_captured{.camera_id = 1,
                                                   .lat = e7(at.latitude_deg),
                                                   .lon = e7(at.longitude_deg),
                                                   .image_index = with().state.pictures++,
                                                   .capture_result = 1});
  } else if (std::holds_alternative<took_off>(what)) {
    say_tabbed(mav_severity::info, "Takeoff detected");
    preflight_ends_ns_ = never_ns;
  } else if (std::holds_alternative<landed>(what)) {
    say_tabbed(mav_severity::info, "Landing detected");
    says_complete_ = says_complete_ || (!run().is_empty() && state().is_in(mode_kind::land));
    if (!flies_mission() && !(state().is_in(mode_kind::mission) && run().state() == run_state::completed))
      disarm_by("landing");
  } else if (std::holds_alternative<mission_completed>(what)) {
    if (holds_at_ns_ == never_ns)
      finish_mission();
  } else if (std::holds_alternative<arrived>(what) && state().is_in(mode_kind::take_off)) {
    enter(mode_kind::hold);
  }
}

void px4::on_time() {
  while (const auto sequence = reached_.due(now().world_ns))
    with().out.send(mavlink::mission_item_reached{static_cast<std::uint16_t>(*sequence)});
  if (now().world_ns >= preflight_ends_ns_) {
    preflight_ends_ns_ = never_ns; // also for who was armed again in the air
    if (!craft().is_in_air())
      disarm_by("auto preflight disarming");
  }
  if (now().world_ns >= disarms_at_ns_) {
    disarms_at_ns_ = never_ns;
    disarm_by("landing");
    enter(mode_kind::mission);
  }
  if (now().world_ns >= holds_at_ns_) {
    holds_at_ns_ = never_ns;
    const bool has_none = is_infeasible_ || run().state() == run_state::completed;
    if (state().is_armed && state().is_in(mode_kind::mission) && has_none)
      enter(mode_kind::hold);
  }
  if (now().world_ns >= trigger_again_ns_) {
    trigger_again_ns_ = never_ns;
    stop_trigger(1);
  }
  act_on_lost_sticks();
}

void px4::act_on_lost_sticks() {
  const bool may_act = state().is_armed && !state().is_in(mode_kind::come_back) && !state().is_in(mode_kind::land);
  const auto step = sticks_.due(now(), may_act);
  if (step == stick_loss::step::none)
    return;
  const bool holds = step == stick_loss::step::holds;
  say_tabbed(mav_severity::critical, holds ? "Failsafe activated: entering Hold for 5 seconds" : "Failsafe activated");
  enter_by_failsafe(holds ? mode_kind::hold : mode_kind::come_back);
}

std::int64_t px4::next_timer_ns() const {
  return std::min(
      {reached_.next_ns(), sticks_.next_ns(), preflight_ends_ns_, trigger_again_ns_, holds_at_ns_, disarms_at_ns_});
}

mavlink::mission_current px4::progress() const {
  auto result = progress_of(run(), with().plans, vehicle_traits(), state().is_in(mode_kind::mission));
  if (says_complete_)
    result.mission_state = mavlink::number(mavlink::mission_state::complete);
  if (is_infeasible_ || (now().world_ns < unchecked_until_ns_ && !run().is_empty()))
    result.mission_state = mavlink::number(mavlink::mission_state::no_mission);
  return result;
}

// -- commands ---------------------------------------------------------------------------------------

autopilot::answer px4::set_mission_current(const role::order&) { return answer::unsupported; } // the message alone

autopilot::answer px4::take_off(const role::order& what) {
  if (!state().has_position)
    return answer::temporarily_rejected;
  const auto own = craft().home().altitude_m + default_takeoff_m;
  takeoff_altitude_m_ = std::isfinite(what.z) && what.z != 0 ? altitude_in(what) : own;
  enter(mode_kind::take_off);
  if (state().is_armed)
    climb_to(takeoff_altitude_m_);
  return answer::accepted;
}

double px4::altitude_in(const role::order& what) const {
  // In a COMMAND_LONG, which names no frame, it means above mean sea level.
  return !what.is_in_integers && std::isfinite(what.z) ? what.z : autopilot::altitude_in(what);
}

autopilot::answer px4::reposition(const role::order& what) {
  if (!state().has_position)
    return answer::temporarily_rejected;
  enter(mode_kind::hold);
  if (state().is_armed && craft().is_in_air())
    go_to(place_in(what));
  return answer::accepted;
}

autopilot::answer px4::pause_or_continue(const role::order&) { return answer::unsupported; }

autopilot::answer px4::restart_or_shut_down(const role::order& what) {
  constexpr float restart_autopilot = 1;
  if (what.param1 != restart_autopilot)
    return answer::accepted; // nothing was asked for
  if (state().is_armed)
    return answer::denied;
  ask_for_restart();
  return answer::accepted;
}

} // namespace godwit::sim
