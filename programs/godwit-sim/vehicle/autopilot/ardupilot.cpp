#include "programs/godwit-sim/vehicle/autopilot/ardupilot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/mavlink/plan_meaning.hpp"
#include "programs/godwit-sim/vehicle/autopilot/mission_progress.hpp"

namespace godwit::sim {

namespace {

using mavlink::mav_cmd;
using mavlink::mav_severity;

constexpr std::string_view unnamed = "?";

// What its texts call a command.
std::string_view name_of(std::uint16_t command) {
  struct row {
    mav_cmd command;
    std::string_view name;
  };
  static constexpr std::array<row, 17> rows{{
      {mav_cmd::nav_waypoint, "WP"},
      {mav_cmd::nav_spline_waypoint, "SplineWP"},
      {mav_cmd::nav_loiter_unlim, "LoitUnlim"},
      {mav_cmd::nav_loiter_turns, "LoitTurns"},
      {mav_cmd::nav_loiter_time, "LoitTime"},
      {mav_cmd::nav_return_to_launch, "RTL"},
      {mav_cmd::nav_land, "Land"},
      {mav_cmd::nav_takeoff, "Takeoff"},
      {mav_cmd::nav_vtol_takeoff, "VTOLTakeoff"},
      {mav_cmd::nav_vtol_land, "VTOLLand"},
      {mav_cmd::do_vtol_transition, "VTOLTransition"},
      {mav_cmd::nav_delay, "Delay"},
      {mav_cmd::do_jump, "Jump"},
      {mav_cmd::do_change_speed, "ChangeSpeed"},
      {mav_cmd::do_set_cam_trigg_dist, "SetCamTrigDst"},
      {mav_cmd::image_start_capture, "ImageStartCapture"},
      {mav_cmd::do_gripper, "Gripper"},
  }};
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const row& r) { return mavlink::number(r.command) == command; });
  return found == rows.end() ? unnamed : found->name;
}

} // namespace

bool is_waypoint(std::uint16_t command) {
  return command == mavlink::number(mav_cmd::nav_waypoint) || command == mavlink::number(mav_cmd::nav_spline_waypoint);
}

// -- arming and modes -------------------------------------------------------------------------------

std::optional<autopilot::refusal> ardupilot::why_not_arm(bool forced) const {
  if (!is_armable(state().mode->kind))
    return refusal{answer::failed, mav_severity::critical, "Arm: Mode not armable"};
  if (forced)
    return std::nullopt;
  if (!state().is_ready || !state().has_estimate)
    return refusal{answer::failed, mav_severity::critical, "Arm: Need Position Estimate"};
  if (state().is_battery_empty)
    return refusal{answer::failed, mav_severity::critical, "Arm: Battery 1 below minimum arming capacity"};
  return std::nullopt;
}

std::optional<autopilot::refusal> ardupilot::why_not_disarm(bool forced) const {
  if (!forced && craft().is_in_air())
    return refusal{answer::failed, mav_severity::warning, "Disarm: not landed"};
  return std::nullopt;
}

std::string ardupilot::why_not(const flight_mode& mode) const {
  if (mode.needs_position && state().is_armed && !(state().has_estimate && state().is_ready))
    return "requires position";
  if (mode.kind != mode_kind::mission || !state().is_armed)
    return {};
  return run().is_empty() || !why_not_auto().empty() ? "init failed" : "";
}

autopilot::answer ardupilot::change_mode(const flight_mode* mode, std::uint32_t number) {
  if (mode == nullptr) {
    say(mav_severity::warning, "No such mode " + std::to_string(number));
    return answer::failed;
  }
  if (mode == state().mode)
    return answer::accepted;
  const auto reason = why_not(*mode);
  if (!reason.empty()) {
    if (mode->kind == mode_kind::mission && !run().is_empty() && !why_not_auto().empty())
      say(mav_severity::critical, why_not_auto());
    say(mav_severity::warning, "Mode change to " + std::string(mode->name) + " failed: " + reason);
    return answer::failed;
  }
  enter(*mode);
  return answer::accepted;
}

void ardupilot::on_mode_left(const flight_mode& mode) {
  if (mode.kind != mode_kind::mission || phase_ != mission_phase::running)
    return;
  run().stop();
  phase_ = mission_phase::stopped;
}

void ardupilot::on_mode_entered(const flight_mode& mode) {
  if (mode.kind == mode_kind::mission && begins_in_auto())
    start_or_resume();
}

void ardupilot::on_restart() {
  load_plan();
  run().forget_jumps();
}

// FENCE_ACTION 1. The HEARTBEAT of the new mode goes out before the text (ArduCopter/fence.cpp; seen in one
// millisecond).
void ardupilot::breach_fence() {
  if (!state().is_armed)
    return;
  say(mav_severity::notice, "Circle fence breached");
  enter(mode_kind::come_back);
}

// -- the mission ------------------------------------------------------------------------------------

autopilot::answer ardupilot::start_mission(const role::order& what) {
  if (what.param1 != 0 || what.param2 != 0) // what is no number differs from 0 as well
    return answer::denied;
  const auto& mode = mode_of_kind(vehicle_traits().modes, mode_kind::mission);
  if (change_mode(&mode, mode.custom) != answer::accepted) {
    say(mav_severity::warning, "Flight mode change failed");
    return answer::failed;
  }
  if (state().is_armed && !run().is_empty())
    start_or_resume();
  return answer::accepted;
}

void ardupilot::start_or_resume() {
  if (phase_ == mission_phase::running || run().is_empty())
    return;
  if (phase_ == mission_phase::complete)
    reset_mission();
  with().craft.keep_trigger();   // AP_Camera, without CAM_AUTO_ONLY
  run().count_left_loops_anew(); // AP_Mission::get_next_cmd, without MIS_OPTIONS DONT_ZERO_COUNTER
  run().start(run().current());
  phase_ = mission_phase::running;
  is_at_beginning_ = false;
}

// The counts of jumps hang on their places in the plan, and stay (AP_Mission::init_jump_tracking has no other callers
// than a reset, item 0 and a mission that was completed).
void ardupilot::load_plan() {
  run().replace(held_mission().items, first_flown, first_flown);
  run().stop();
  phase_ = mission_phase::stopped;
  is_at_beginning_ = true;
}

void ardupilot::reset_mission() {
  run().load(held_mission().items, first_flown);
  if (phase_ == mission_phase::running)
    phase_ = mission_phase::stopped;
  is_at_beginning_ = true;
}

void ardupilot::on_change(const plans::plan_change& what) {
  if (what.type != mavlink::mav_mission_type::mission)
    return;
  const bool is_cut = what.kind == plans::plan_change_kind::begun_replacing;
  if (run().current() >= what.count || (!is_cut && phase_ == mission_phase::complete))
    load_plan(); // what was being flown is no more
  else if (!is_cut || what.count < run().count())
    take_plan_under_way();
}

// AP_Mission keeps its place while its items are written, and AP_Mission_ChangeDetector looks at the next three: where
// they say something else the leg to a waypoint begins anew.
void ardupilot::take_plan_under_way() {
  constexpr int looked_at = 3;
  const auto& items = held_mission().items;
  const auto next_of = [from = run().current()](std::span<const mavlink::mission_item_int> plan) {
    std::vector<mavlink::mission_item_int> result;
    for (auto i = static_cast<std::size_t>(from); i < plan.size() && std::ssize(result) < looked_at; ++i)
      if (is_nav(plan[i]))
        result.push_back(plan[i]);
    return mavlink::checksum_of(result);
  };
  const bool is_another = next_of(run().items()) != next_of(items);
  const bool restarts = is_another && flies_mission() && is_waypoint(command_of(run().current()));
  run().replace(items, first_flown, run().current());
  if (restarts && says_mission_changed())
    say(mav_severity::critical, "Auto mission changed, restarted command");
}

void ardupilot::on_half_a_plan() {
  if (run().current() < std::ssize(held_mission().items))
    take_plan_under_way();
  else
    load_plan();
}

bool ardupilot::choose(int sequence) {
  if (run().is_empty() || !run().set_current(std::max(sequence, first_flown)))
    return false;
  if (phase_ == mission_phase::complete || sequence < first_flown)
    run().forget_jumps();
  if (phase_ == mission_phase::complete)
    phase_ = mission_phase::stopped;
  is_at_beginning_ = sequence < first_flown;
  if (state().is_in(mode_kind::mission) && begins_in_auto())
    start_or_resume();
  return true;
}

void ardupilot::take(const mavlink::mission_set_current& m) {
  if (!choose(m.seq))
    return;
  const auto there = aim_back();
  with().out.send(progress());
}

autopilot::answer ardupilot::set_mission_current(const role::order& what) {
  constexpr float keep = -1;
  constexpr float reset = 1;
  if (!(what.param1 >= keep && what.param1 < static_cast<float>(run().count())))
    return answer::denied;
  if (what.param2 == reset)
    reset_mission();
  if (what.param1 != keep && !choose(static_cast<int>(what.param1)))
    return answer::denied;
  owe(mavlink::mission_current::message_id);
  return answer::accepted;
}

void ardupilot::tell_begun(int sequence) {
  is_at_beginning_ = false;
  say(mav_severity::info, "Mission: " + std::to_string(sequence) + " " + std::string(name_of(command_of(sequence))));
}

// A command to a gripper is acknowledged by a text also where there is none.
void ardupilot::tell_executed(int sequence) {
  const auto& item = run().items()[static_cast<std::size_t>(sequence)];
  if (const auto name = name_of(item.command); name != unnamed)
    say(mav_severity::info, "Mission: " + std::to_string(sequence) + " " + std::string(name));
  if (item.command != mavlink::number(mav_cmd::do_gripper))
    return;
  const bool releases = item.param2 == 0;
  if (state().has_payload)
    say(mav_severity::info, releases ? "Gripper load releasing" : "Gripper load grabbing");
  say(mav_severity::info, releases ? "Gripper Released" : "Gripper Grabbed");
}

void ardupilot::tell_picture() {
  if (!state().has_payload)
    return;
  const auto& at = craft().where().where;
  mavlink::camera_feedback m;
  m.time_usec = static_cast<std::uint64_t>(now().world_ns / 1'000);
  m.img_idx = static_cast<std::uint16_t>(++with().state.pictures);
  m.lat = e7(at.latitude_deg);
  m.lng = e7(at.longitude_deg);
  m.alt_msl = static_cast<float>(at.altitude_m);
  m.alt_rel = static_cast<float>(craft().altitude_above_home_m());
  with().out.send(m);
}

void ardupilot::tell_reached(int sequence) {
  with().out.send(mavlink::mission_item_reached{static_cast<std::uint16_t>(sequence)});
  if (const auto words = words_of_reached(sequence); !words.empty())
    say(mav_severity::info, words);
}

void ardupilot::set_back_and_running() {
  phase_ = mission_phase::running;
  is_at_beginning_ = false;
}

void ardupilot::on_happening(const happening& what) {
  if (!state().is_armed)
    return; // the landing has ended it
  if (const auto* begun = std::get_if<item_begun>(&what)) {
    tell_begun(begun->sequence);
    on_item_begun(begun->sequence);
  } else if (const auto* reached = std::get_if<item_reached>(&what)) {
    tell_reached(reached->sequence);
  } else if (const auto* skipped = std::get_if<item_skipped>(&what)) {
    say(mav_severity::warning, "Skipping invalid cmd #" + std::to_string(skipped->sequence));
  } else if (const auto* executed = std::get_if<command_executed>(&what)) {
    tell_executed(executed->sequence);
  } else if (std::holds_alternative<pictured>(what)) {
    tell_picture();
  } else if (const auto* load = std::get_if<load_moved>(&what); load != nullptr && state().has_payload) {
    say(mav_severity::info, load->is_released ? "Gripper load released" : "Gripper load grabbed");
  } else if (std::holds_alternative<took_off>(what)) {
    on_took_off();
  } else if (std::holds_alternative<landed>(what)) {
    on_landed();
  } else if (std::holds_alternative<mission_completed>(what)) {
    phase_ = mission_phase::complete;
    on_completed();
  }
}

mavlink::mission_current ardupilot::progress() const {
  auto m = place_in_mission(run(), with().plans, vehicle_traits());
  if (is_at_beginning_)
    m.seq = 0;
  m.mission_mode = mavlink::number(state().is_in(mode_kind::mission) ? mavlink::mission_mode::active
                                                                     : mavlink::mission_mode::unknown);
  auto how = mavlink::mission_state::not_started; // also when it was stopped under way
  if (run().is_empty())
    how = mavlink::mission_state::no_mission;
  else if (phase_ == mission_phase::complete)
    how = mavlink::mission_state::complete;
  else if (phase_ == mission_phase::running)
    how = mavlink::mission_state::active;
  m.mission_state = mavlink::number(how);
  return m;
}

// -- commands ---------------------------------------------------------------------------------------

autopilot::answer ardupilot::reposition(const role::order& what) {
  if (!what.is_in_integers)
    return answer::unsupported; // a float would round the place
  constexpr float change_mode_flag = 1;
  const bool may_change = std::isfinite(what.param2) && std::fmod(what.param2, 2.0F) == change_mode_flag;
  const auto& guided = mode_of_kind(vehicle_traits().modes, mode_kind::guided);
  if (!may_change && state().mode != &guided)
    return answer::denied;
  if (change_mode(&guided, guided.custom) != answer::accepted)
    return answer::failed;
  if (state().is_armed && goes_to_places())
    go_to(place_in(what));
  return answer::accepted;
}

// Only in GUIDED (handle_guided_request of each vehicle).
bool ardupilot::fly_to(const role::order& what) {
  if (!state().is_in(mode_kind::guided))
    return false;
  if (state().is_armed && craft().is_in_air())
    go_to(place_in(what));
  return true;
}

autopilot::answer ardupilot::restart_or_shut_down(const role::order& what) {
  constexpr float restart_autopilot = 1;
  if (what.param1 != restart_autopilot)
    return answer::unsupported;
  if (state().is_armed)
    return answer::failed;
  ask_for_restart();
  return answer::accepted;
}

} // namespace godwit::sim
