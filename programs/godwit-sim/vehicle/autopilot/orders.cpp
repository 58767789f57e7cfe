// Commands: who handles which, and those that all personalities take alike.
#include <algorithm>
#include <array>
#include <cmath>

#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"

namespace godwit::sim {

namespace {

using mavlink::mav_cmd;
using mavlink::mav_result;

constexpr float forced_by = 21196; // param2 of COMPONENT_ARM_DISARM: without a look at safety

} // namespace

autopilot::handler autopilot::handler_for(std::uint16_t command) {
  using mavlink::number;
  static constexpr std::array<row, 20> rows{{
      {number(mav_cmd::nav_loiter_unlim), &autopilot::loiter},
      {number(mav_cmd::nav_return_to_launch), &autopilot::return_home},
      {number(mav_cmd::nav_land), &autopilot::land},
      {number(mav_cmd::nav_takeoff), &autopilot::take_off},
      {number(mav_cmd::do_set_mode), &autopilot::set_mode},
      {number(mav_cmd::do_change_speed), &autopilot::change_speed},
      {number(mav_cmd::do_set_home), &autopilot::set_home},
      {number(mav_cmd::do_land_start), &autopilot::start_landing},
      {number(mav_cmd::do_reposition), &autopilot::reposition},
      {number(mav_cmd::do_pause_continue), &autopilot::pause_or_continue},
      {number(mav_cmd::do_set_mission_current), &autopilot::set_mission_current},
      {number(mav_cmd::mission_start), &autopilot::start_mission},
      {number(mav_cmd::component_arm_disarm), &autopilot::arm_or_disarm},
      {number(mav_cmd::set_message_interval), &autopilot::set_message_interval},
      {number(mav_cmd::request_message), &autopilot::request_message},
      {number(mav_cmd::preflight_reboot_shutdown), &autopilot::restart_or_shut_down},
      {number(mav_cmd::get_home_position), &autopilot::get_home},
      {number(mav_cmd::get_message_interval), &autopilot::get_message_interval},
      {number(mav_cmd::request_protocol_version), &autopilot::request_protocol_version},
      {number(mav_cmd::request_autopilot_capabilities), &autopilot::request_capabilities},
  }};
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const row& r) { return r.command == command; });
  return found == rows.end() ? nullptr : found->handle;
}

mav_result autopilot::carry_out(const role::order& what) {
  if (const auto refused = refusals_.take(what.command))
    return static_cast<mav_result>(*refused);
  const auto handle = handler_for(what.command);
  return handle == nullptr ? mav_result::unsupported : (this->*handle)(what);
}

void autopilot::take(const role::order& what) {
  const auto result = carry_out(what);
  acknowledge(what, result);
  if (owed_message_) {
    const bool is_for_all = *owed_message_ == mavlink::home_position::message_id;
    const auto there = with_.out.aim(is_for_all ? outlet::line_set{}.set() : outlet::only(with_.out.line_of_event()));
    static_cast<void>(give(*owed_message_));
    owed_message_.reset();
  }
}

mav_result autopilot::arm_or_disarm(const role::order& what) {
  const bool forced = what.param2 == forced_by;
  if (what.param1 != 0 && what.param1 != 1)
    return mav_result::denied;
  const bool arms = what.param1 == 1;
  if (arms == state().is_armed)
    return mav_result::accepted;
  if (const auto refused = arms ? why_not_arm(forced) : why_not_disarm(forced)) {
    say(refused->severity, refused->text);
    return refused->result;
  }
  if (arms)
    arm();
  else
    disarm();
  return mav_result::accepted;
}

mav_result autopilot::set_mode(const role::order& what) {
  const auto is_custom = std::isfinite(what.param1) && std::fmod(what.param1, 2.0F) == 1; // its lowest bit
  if (!is_custom)
    return mav_result::denied;
  const auto number = mode_in(what);
  const auto* mode = find_mode(autopilot_quirks().modes, number);
  if (mode == nullptr)
    on_unknown_mode(what);
  return change_mode(mode, number);
}

mav_result autopilot::return_home(const role::order&) {
  const auto& mode = mode_of_kind(autopilot_quirks().modes, mode_kind::come_back);
  return change_mode(&mode, mode.custom);
}

mav_result autopilot::loiter(const role::order&) {
  const auto& mode = mode_of_kind(autopilot_quirks().modes, mode_kind::hold);
  return change_mode(&mode, mode.custom);
}

mav_result autopilot::land(const role::order&) {
  if (!has_mode_of_kind(autopilot_quirks().modes, mode_kind::land))
    return mav_result::unsupported;
  const auto& mode = mode_of_kind(autopilot_quirks().modes, mode_kind::land);
  return change_mode(&mode, mode.custom);
}

mav_result autopilot::change_speed(const role::order& what) {
  constexpr float keep = -1;
  constexpr float own = -2;
  if (what.param2 == keep)
    return mav_result::accepted;
  if (what.param2 != own && !(what.param2 > 0 && std::isfinite(what.param2)))
    return mav_result::denied;
  speed_mps_ = what.param2 == own ? 0 : what.param2;
  if (const auto* going = std::get_if<task::go>(&craft().current_task()))
    go_to(position(going->to));
  return mav_result::accepted;
}

mav_result autopilot::set_home(const role::order& what) {
  if (!state().has_position)
    return mav_result::failed;
  const bool is_here = what.param1 == 1;
  move_home(is_here ? craft().where().where : place_in(what));
  with_.state.is_home_fixed = !(is_here && autopilot_quirks().home_is_free_again);
  owed_message_ = mavlink::home_position::message_id;
  return mav_result::accepted;
}

} // namespace godwit::sim
