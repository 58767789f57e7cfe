// Commands: who handles which, and those that all personalities take alike.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "programs/godwit-sim/vehicle/autopilot/autopilot.hpp"

namespace godwit::sim {

namespace {

using mavlink::mav_cmd;
using mavlink::mav_result;

constexpr float forced_by = 21196; // param2 of COMPONENT_ARM_DISARM: without a look at safety

} // namespace

autopilot::handler autopilot::handler_for(std::uint16_t command) {
  using mavlink::number;
  static constexpr std::array<row, 23> rows{{
      {number(mav_cmd::nav_loiter_unlim), &autopilot::loiter},
      {number(mav_cmd::nav_return_to_launch), &autopilot::return_home},
      {number(mav_cmd::nav_land), &autopilot::land},
      {number(mav_cmd::nav_takeoff), &autopilot::take_off},
      {number(mav_cmd::do_set_mode), &autopilot::set_mode},
      {number(mav_cmd::do_change_speed), &autopilot::change_speed},
      {number(mav_cmd::do_set_home), &autopilot::set_home},
      {number(mav_cmd::do_set_roi), &autopilot::look_at},
      {number(mav_cmd::do_set_roi_location), &autopilot::look_at},
      {number(mav_cmd::do_set_roi_none), &autopilot::look_at},
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

mav_result autopilot::execute(const role::order& what) {
  if (const auto refused = refusals_.take(what.command))
    return static_cast<mav_result>(*refused);
  const auto handle = handler_for(what.command);
  return handle == nullptr ? mav_result::unsupported : (this->*handle)(what);
}

void autopilot::take(const role::order& what) {
  const auto result = execute(what);
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
  on_mode_commanded(what);
  const auto number = mode_in(what);
  return change_mode(find_mode(vehicle_traits().modes, number), number);
}

mav_result autopilot::return_home(const role::order&) {
  const auto& mode = mode_of_kind(vehicle_traits().modes, mode_kind::come_back);
  return change_mode(&mode, mode.custom);
}

mav_result autopilot::loiter(const role::order&) {
  const auto& mode = mode_of_kind(vehicle_traits().modes, mode_kind::hold);
  return change_mode(&mode, mode.custom);
}

mav_result autopilot::land(const role::order&) {
  if (!has_mode_of_kind(vehicle_traits().modes, mode_kind::land))
    return mav_result::unsupported;
  const auto& mode = mode_of_kind(vehicle_traits().modes, mode_kind::land);
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
  else if (flies_mission() && speed_mps_ > 0)
    with().craft.change_speed(speed_mps_);
  return mav_result::accepted;
}

mav_result autopilot::look_at(const role::order& what) {
  const bool is_none = what.command == number(mav_cmd::do_set_roi_none);
  with().craft.look_at(is_none ? std::nullopt : std::optional(place_in(what)));
  return mav_result::accepted;
}

mav_result autopilot::set_home(const role::order& what) {
  if (!state().has_position)
    return mav_result::failed;
  const bool is_here = what.param1 == 1;
  move_home(is_here ? craft().where().where : place_in(what));
  with_.state.is_home_fixed = !(is_here && vehicle_traits().home_is_free_again);
  owed_message_ = mavlink::home_position::message_id;
  return mav_result::accepted;
}

// Commands that ask for messages, once or at an interval.

namespace {

// MESSAGE_INTERVAL (244), whose field `message_id` is in the way of a struct: interval_us i32, message_id u16.
constexpr std::uint32_t message_interval_id = 244;
constexpr std::uint8_t message_interval_crc_extra = 95;
constexpr std::size_t message_interval_size = 6;

std::optional<std::uint32_t> message_in(float param) {
  if (!std::isfinite(param) || param < 0 || param >= 0x1p24F || std::trunc(param) != param)
    return std::nullopt;
  return static_cast<std::uint32_t>(param);
}

} // namespace

mav_result autopilot::give(std::uint32_t message) {
  if (message == mavlink::mission_current::message_id && vehicle_traits().current_is_a_request_away) {
    with_.out.send(progress());
    return mav_result::accepted;
  }
  return with_.tells.send(message, now_.world_ns) ? mav_result::accepted : vehicle_traits().unknown_message;
}

// On the line of who asks: a PX4 before its answer, an ArduPilot after it.
mav_result autopilot::give_or_owe(std::uint32_t message) {
  if (vehicle_traits().sends_before_ack) {
    const auto there = aim_back();
    return give(message);
  }
  owed_message_ = message;
  return mav_result::accepted;
}

mav_result autopilot::request_message(const role::order& what) {
  const auto message = message_in(what.param1);
  if (!message)
    return vehicle_traits().unknown_message;
  const bool is_current =
      *message == mavlink::mission_current::message_id && vehicle_traits().current_is_a_request_away;
  if (!vehicle_traits().sends_before_ack && !is_current && !with_.tells.knows(*message))
    return vehicle_traits().unknown_message;
  return give_or_owe(*message);
}

mav_result autopilot::set_message_interval(const role::order& what) {
  const auto message = message_in(what.param1);
  const bool is_interval =
      std::isfinite(what.param2) && std::abs(what.param2) < static_cast<float>(role::message_schedule::max_interval_us);
  const auto interval_us = is_interval ? static_cast<std::int64_t>(what.param2) : -2; // one that is none
  if (message == mavlink::mission_current::message_id && vehicle_traits().current_is_a_request_away &&
      interval_us >= -1) {
    const auto period_ns = interval_us == 0 ? role::current_report::period_ns : interval_us * 1'000;
    streams().current.set_period(std::max<std::int64_t>(period_ns, 0), now_.world_ns);
    return mav_result::accepted;
  }
  if (message && streams().messages.set_interval(*message, interval_us, now_.world_ns))
    return mav_result::accepted;
  if (vehicle_traits().autopilot == mavlink::mav_autopilot::ardupilotmega && message)
    say(mavlink::mav_severity::info, "No ap_message for mavlink id (" + std::to_string(*message) + ")");
  return vehicle_traits().unknown_interval;
}

mav_result autopilot::get_message_interval(const role::order& what) {
  const auto message = message_in(what.param1);
  if (!message)
    return mav_result::denied;
  const auto interval_us = streams().messages.interval_us(*message);
  const auto id = static_cast<std::uint16_t>(*message);
  std::array<std::byte, message_interval_size> payload{};
  std::memcpy(payload.data(), &interval_us, sizeof interval_us);
  std::memcpy(payload.data() + sizeof interval_us, &id, sizeof id);
  const auto there = aim_back();
  with_.out.send_payload(message_interval_id, message_interval_crc_extra, payload);
  return mav_result::accepted;
}

mav_result autopilot::request_capabilities(const role::order&) {
  return give_or_owe(mavlink::autopilot_version::message_id);
}

mav_result autopilot::request_protocol_version(const role::order&) {
  if (!vehicle_traits().tells_protocol_version)
    return mav_result::unsupported;
  const auto there = aim_back();
  return give(mavlink::protocol_version::message_id);
}

mav_result autopilot::get_home(const role::order&) { return give_or_owe(mavlink::home_position::message_id); }

} // namespace godwit::sim
