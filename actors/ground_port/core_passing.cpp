// The part of the core that passes on: what of a station's goes to the vehicle, and what of the vehicle's comes back.
// Which list a message is on: passing/table.hpp.
//
//   a person's ──> act_queue ──> the executor is asked ──pass──> to the vehicle
//                                       │           └──its COMMAND_ACK──> the executor: whose the vehicle is
//                                       ├──done──> ACCEPTED: the vehicle is so already
//                                       ├──begun──> godwit does it; ACCEPTED when the vehicle has accepted that
//                                       ├──refused──> TEMPORARILY_REJECTED, and the reason
//                                       └──no answer──> what ends the vehicle's motion goes on, with the failsafe told
//                                                       first; all else is refused
// What people do is a row of the audit: one when a stream of sticks or of parameters begins (passing/act_queue.hpp).
//
//   mission mode ──> as MISSION_START, as going on where the flight is paused, or the way back from a go to; hold ──>
//   the executor decides
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/ground_port/command_reading.hpp"
#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "actors/ground_port/passing/as_said.hpp"
#include "actors/ground_port/passing/file_transfer.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"

namespace godwit::ground_port {

namespace {

using executor::act_kind;
using flight::mode_kind;
using mavlink::mav_cmd;
using mavlink::mav_result;
using mavlink::mav_severity;
using passing::as_said;
using passing::pass_list;
using vehicle_link::relayed_frame;

// Streams of these are what fences and the flight are judged by: no station makes them slower than this.
constexpr std::array<std::uint8_t, 5> streams_that_are_needed{0, 2, 6, 10, 12}; // all, status, position, extra 1 and 3
constexpr std::uint16_t least_rate_hz = 4;

constexpr std::uint32_t custom_flag = 1; // MAV_MODE_FLAG_CUSTOM_MODE_ENABLED

act_kind kind_of(const passing::command_row& row, const vehicle_role::order& what) {
  const bool is_disarm = what.command == mavlink::number(mav_cmd::component_arm_disarm) && what.param1 == 0;
  return is_disarm ? act_kind::stop : row.kind;
}

std::string name_of_act(const passing::command_row& row, const vehicle_role::order& what) {
  return kind_of(row, what) == act_kind::stop && row.kind == act_kind::arm ? "Disarm" : std::string(row.name);
}

// MAV_CMD_DO_SET_MODE: PX4 has main and sub mode in two parameters.
std::uint32_t custom_mode_in(const vehicle_role::order& what, mavlink::mav_autopilot autopilot) {
  const auto number = [](float value) {
    return value >= 0 && value < 16'777'216.0F ? static_cast<std::uint32_t>(value) : 0U;
  };
  if (autopilot == mavlink::mav_autopilot::px4)
    return number(what.param2) << 16U | (number(what.param3) & 0xFFU) << 24U;
  return number(what.param2);
}

} // namespace

bool core::is_passing(std::int64_t now_ns) const {
  return settings_.passes && !stood_down_ && !is_autopilot_here(now_ns);
}

bool core::is_allowed(std::string_view name) const {
  return std::ranges::find(settings_.also_passes, name) != settings_.also_passes.end();
}

void core::pass(decision_context& t, relayed_frame what) {
  ++counts_.passed_to_vehicle;
  t.done.emplace_back(pass_on{std::move(what)});
}

// -- from stations ----------------------------------------------------------------------------------

bool core::route(decision_context& t, station& from, const mavlink::frame_view& frame) {
  const auto* const row = passing::find_message(frame.id());
  if (row == nullptr || !is_passing(t.now.monotonic_ns))
    return false;
  const auto target = passing::target_of(*row, frame);
  const bool is_for_another = target.system != 0 && target.system != settings_.as.system;
  if (row->on == pass_list::owned)
    return !is_for_another && route_item(t, frame);
  if (is_for_another) {
    ++counts_.not_for_us;
    return true;
  }
  if (target.system != 0 && target.component != 0 && target.component == ourselves().component && !is_standing_in())
    return false; // godwit itself is meant
  switch (frame.id()) {
  case mavlink::heartbeat::message_id:
    pass_reading(t, as_said(frame));
    return false; // and it is counted here
  case mavlink::command_long::message_id:
    route_command(t, from, vehicle_role::read_order(from.who, mavlink::decode<mavlink::command_long>(frame)), frame,
                  target.system == 0);
    return true;
  case mavlink::command_int::message_id:
    route_command(t, from, vehicle_role::read_order(from.who, mavlink::decode<mavlink::command_int>(frame)), frame,
                  target.system == 0);
    return true;
  case mavlink::set_mode::message_id: {
    const auto m = mavlink::decode<mavlink::set_mode>(frame);
    route_mode(t, order_of_mode(from.who), m.custom_mode, m.base_mode, frame);
    return true;
  }
  case mavlink::request_data_stream::message_id:
    pass_reading(t, needed_rate(mavlink::decode<mavlink::request_data_stream>(frame), from.who));
    return true;
  case file_transfer_id:
    route_file(t, from, frame);
    return true;
  default:
    route_listed(t, from, *row, frame);
    return true;
  }
}

void core::route_listed(decision_context& t, station& from, const passing::message_row& row,
                        const mavlink::frame_view& frame) {
  switch (row.on) {
  case pass_list::passes:
    return pass_reading(t, as_said(frame));
  case pass_list::person:
    if (are_sticks_at_rest(from, row, frame, t.now.monotonic_ns)) // an autopilot that misses them acts by itself
      return pass_reading(t, as_said(frame));
    return ask(t, {{row.kind, by(from.who), std::string(row.name)}, as_said(frame)});
  case pass_list::disarmed:
    return ask(t, {{act_kind::configure, by(from.who), std::string(row.name)}, as_said(frame)});
  case pass_list::setting:
    if (is_allowed(row.name))
      return pass_reading(t, as_said(frame));
    if (row.id == mavlink::system_time::message_id) { // stations give it to each vehicle as they connect
      ++counts_.not_accepted;
      return;
    }
    break;
  case pass_list::owned:
    break;
  }
  refuse_passing(t, from, std::string(row.name) + " is not passed on");
}

bool core::are_sticks_at_rest(const station& from, const passing::message_row& row, const mavlink::frame_view& frame,
                              std::int64_t now_ns) {
  constexpr std::uint32_t manual_control = 69;
  return row.id == manual_control && !sticks_.is_held(from.who, frame.payload(), now_ns);
}

// Not slower than what godwit itself needs, and never off.
relayed_frame core::needed_rate(mavlink::request_data_stream m, mavlink::sender who) {
  if (std::ranges::find(streams_that_are_needed, m.req_stream_id) != streams_that_are_needed.end()) {
    m.req_message_rate = std::max(m.req_message_rate, least_rate_hz);
    m.start_stop = 1;
  }
  return as_said(m, who);
}

void core::pass_reading(decision_context& t, relayed_frame what) {
  if (to_vehicle_.take(what.payload.size(), t.now.monotonic_ns))
    pass(t, std::move(what));
}

void core::refuse_passing(decision_context& t, station& from, const std::string& why) {
  ++counts_.passing_refused;
  const auto now = t.now.monotonic_ns;
  if (from.told_about_passing_ns && now - *from.told_about_passing_ns < passing_notice_period_ns)
    return;
  from.told_about_passing_ns = now;
  t.say(mav_severity::warning, why, from.peer);
}

void core::route_file(decision_context& t, station& from, const mavlink::frame_view& frame) {
  switch (passing::file_access_of(frame.payload())) {
  case passing::file_access::read:
    return pass_reading(t, as_said(frame));
  case passing::file_access::write:
    return ask(t, {{act_kind::configure, by(from.who), "Writing a file"}, as_said(frame)});
  case passing::file_access::write_plan:
    refuse_file(t, as_said(frame));
    return refuse_passing(t, from, "Plans are uploaded to godwit, not as files");
  }
}

void core::refuse_file(decision_context& t, const relayed_frame& asked) {
  const mavlink::sender to{asked.system, asked.component};
  const auto answer = passing::file_refusal(std::as_bytes(std::span(asked.payload)), to);
  t.send_as_said(stations_.way_to(to), {file_transfer_id, autopilot().system, autopilot().component, answer});
}

// -- commands ---------------------------------------------------------------------------------------

void core::route_command(decision_context& t, station& from, const vehicle_role::order& what,
                         const mavlink::frame_view& frame, bool is_for_all) {
  const auto* const row = passing::find_command(what.command);
  if (row == nullptr) {
    ++counts_.commands_unsupported;
    refuse_passing(t, from, "Command " + std::to_string(what.command) + " is not passed on");
    if (!is_for_all)
      answer(t, what, mav_result::unsupported);
    return;
  }
  switch (row->on) {
  case pass_list::owned:
    return route_owned(t, from, what, frame, is_for_all);
  case pass_list::passes:
    if (answers_itself(what))
      return obey(t, what, is_for_all);
    return pass_reading(t, as_said(frame));
  case pass_list::person:
    if (what.command == mavlink::number(mav_cmd::do_set_mode)) {
      const auto base = what.param1 >= 0 && what.param1 <= 255 ? static_cast<std::uint32_t>(what.param1) : 0U;
      return route_mode(t, what, custom_mode_in(what, owner_.autopilot), base, frame);
    }
    return ask(t, {{kind_of(*row, what), by(from.who), name_of_act(*row, what)}, as_said(frame), what});
  case pass_list::disarmed:
    return ask(t, {{act_kind::configure, by(from.who), std::string(row->name)}, as_said(frame), what});
  case pass_list::setting:
    if (is_allowed(row->name))
      return ask(t, {{act_kind::configure, by(from.who), std::string(row->name)}, as_said(frame), what});
    answer(t, what, mav_result::denied);
    return refuse_passing(t, from, std::string(row->name) + " is not passed on (ground.also_passes)");
  }
}

// Whether a hold and a go-to are godwit's depends on who has the vehicle, which the executor knows.
void core::route_owned(decision_context& t, station& from, const vehicle_role::order& what,
                       const mavlink::frame_view& frame, bool is_for_all) {
  const bool is_reposition = what.command == mavlink::number(mav_cmd::do_reposition);
  const bool is_loiter = what.command == mavlink::number(mav_cmd::nav_loiter_unlim);
  if (is_loiter || (is_reposition && is_pause_by_reposition(what, told_to(from.who, t.now.monotonic_ns)))) {
    if (const auto place = here(); place && (is_loiter || std::isnan(what.z)))
      held_from_ = held_from{from.who, place->altitude_m, t.now.monotonic_ns};
    return ask(t, {{act_kind::hold, by(from.who), "Hold"}, as_said(frame), what});
  }
  if (is_reposition)
    return ask(t, {{act_kind::go_to, by(from.who), name_for_people(what)}, as_said(frame), what});
  obey(t, what, is_for_all);
}

// What godwit knows, or what it keeps at its own rate on this line.
bool core::answers_itself(const vehicle_role::order& what) const {
  switch (what.command) {
  case mavlink::number(mav_cmd::set_message_interval): {
    const auto id = message_id_in(what.param1);
    return id && (forwarded_messages::contains(*id) || *id == mavlink::heartbeat::message_id);
  }
  case mavlink::number(mav_cmd::request_message): {
    const auto id = message_id_in(what.param1);
    return id && (*id == mavlink::protocol_version::message_id || *id == mavlink::mission_current::message_id ||
                  is_known(*id));
  }
  case mavlink::number(mav_cmd::get_home_position):
    return is_known(mavlink::home_position::message_id);
  case mavlink::number(mav_cmd::request_autopilot_capabilities):
    return is_known(mavlink::autopilot_version::message_id);
  case mavlink::number(mav_cmd::request_protocol_version):
    return true;
  default:
    return false;
  }
}

bool core::is_known(std::uint32_t id) const { return forwarded_messages::contains(id) && gate_.newest(id).has_value(); }

// -- modes ------------------------------------------------------------------------------------------

// MAVLink has no answer to SET_MODE; a PX4 answers it as DO_SET_MODE.
vehicle_role::order core::order_of_mode(mavlink::sender who) const {
  vehicle_role::order result{.from = who};
  if (owner_.autopilot != mavlink::mav_autopilot::px4)
    return result;
  result.command = mavlink::number(mav_cmd::do_set_mode);
  result.target_component = autopilot().component;
  return result;
}

// Of the base mode the custom flag alone counts. Stations copy the rest from the vehicle's heartbeat, its armed flag
// too: a mode command arms nothing (MAVLink, MAV_MODE_FLAG_SAFETY_ARMED).
void core::route_mode(decision_context& t, const vehicle_role::order& what, std::uint32_t custom_mode,
                      std::uint32_t base_mode, const mavlink::frame_view& frame) {
  if (owner_ == flight::mode_owner{})
    return refuse(t, what, mav_result::temporarily_rejected, "Mode: the vehicle is not heard");
  if ((base_mode & custom_flag) == 0)
    return refuse(t, what, mav_result::denied, "Mode: only custom modes are taken");
  const auto mode = flight::mode_of(owner_, custom_mode);
  executor::station_act act{act_kind::command, by(what.from),
                            "Mode " + std::string(io::name_of(mode.kind)) + " (" + std::to_string(custom_mode) + ")"};
  switch (mode.kind) {
  case mode_kind::mission:
    if (is_in_flight() && progress_->is_sent_elsewhere && is_armed_) // back to the mission, as a vehicle alone would go
      return say_word_of(t, what, operators::command_kind::cancel);
    return start_or_resume(t, what, act.what);
  case mode_kind::hold: // in another mode of holding (Copter's LOITER) a person's sticks fly it
    act.kind = flight::number_of(owner_, mode_kind::hold) == custom_mode ? act_kind::hold : act_kind::stop;
    break;
  case mode_kind::returning:
  case mode_kind::landing:
    act.kind = act_kind::stop;
    break;
  default:
    break;
  }
  ask(t, {std::move(act), as_said(frame), what});
}

void core::start_or_resume(decision_context& t, vehicle_role::order what, const std::string& name) {
  if (rules_.look() && is_refused(t, what, "Mission start"))
    return;
  const bool is_held = std::exchange(is_hold_asked_, false);
  if (!is_held && is_running() && is_mode_known_ && mode_.kind == mode_kind::mission)
    return answer(t, what, mav_result::accepted);
  what.param1 = what.param2 = 0;
  const auto state = progress_ ? progress_->state : mavlink::mission_state::unknown;
  const bool is_paused = is_armed_ && (is_held || state == mavlink::mission_state::paused);
  if (is_paused && !noted_start_item_)
    return ask_to_go_on(t, what, name);
  start(t, what);
}

// -- to stations ------------------------------------------------------------------------------------

effects core::on_relayed(const relayed_frame& m, instant now) {
  decision_context t(*this, now);
  if (m.message == mavlink::command_ack::message_id)
    on_acknowledgement(t, m);
  if (m.message == mavlink::mission_ack::message_id && !is_answer_to_item(m, now.monotonic_ns))
    return std::move(t.done);
  if (!is_passing(now.monotonic_ns) || !to_stations_.take(m.payload.size(), now.monotonic_ns)) {
    ++counts_.not_passed_to_stations;
  } else {
    t.send_as_said(way_of(m), m);
    ++counts_.passed_to_stations;
  }
  finish(t);
  return std::move(t.done);
}

// Where it names a station, there alone.
io::link::peer_id core::way_of(const relayed_frame& m) const {
  constexpr std::size_t in_command_ack = 8;
  constexpr std::size_t in_file_transfer = 1;
  constexpr std::size_t in_mission_ack = 0;
  const bool is_plan_answer = m.message == mavlink::mission_ack::message_id;
  const bool is_targeted =
      m.message == mavlink::command_ack::message_id || m.message == file_transfer_id || is_plan_answer;
  const auto at = m.message == mavlink::command_ack::message_id ? in_command_ack
                  : is_plan_answer                              ? in_mission_ack
                                                                : in_file_transfer;
  if (!is_targeted || at + 1 >= m.payload.size())
    return io::link::every_peer;
  return stations_.way_to({m.payload[at], m.payload[at + 1]});
}

} // namespace godwit::ground_port
