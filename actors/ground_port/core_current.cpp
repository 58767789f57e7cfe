// The part of the core that is about the progress of a plan and its current item.
#include <string>
#include <utility>

#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "actors/ground_port/mission_server/item_forms.hpp"
#include "actors/ground_port/passing/as_said.hpp"

namespace godwit::ground_port {

namespace {

using executor::current_verdict;
using mavlink::mav_mission_type;
using mavlink::mav_result;
using mavlink::mav_severity;
using mavlink::mission_state;

constexpr std::uint16_t no_mission_total = 65'535;

mav_result result_for(current_verdict verdict) {
  switch (verdict) {
  case current_verdict::going:
    return mav_result::accepted;
  case current_verdict::not_running:
  case current_verdict::not_now:
    return mav_result::temporarily_rejected;
  case current_verdict::no_such_item:
    return mav_result::denied;
  case current_verdict::failed:
    break;
  }
  return mav_result::failed;
}

} // namespace

// -- progress -------------------------------------------------------------------------------------

bool core::is_running() const {
  const auto& mission = shown_[place_of(mav_mission_type::mission)];
  return progress_ && mission.items != 0 && progress_->plan_id == mission.id &&
         progress_->state == mission_state::active;
}

bool core::is_in_flight() const {
  return progress_ && (progress_->state == mission_state::active || progress_->state == mission_state::paused);
}

mavlink::mission_current core::current() const {
  const auto& mission = shown_[place_of(mav_mission_type::mission)];
  mavlink::mission_current result;
  result.mission_id = mission.id;
  result.fence_id = shown_[place_of(mav_mission_type::fence)].id;
  result.rally_points_id = shown_[place_of(mav_mission_type::rally)].id;
  // An ArduPilot's home, which is its item 0, does not count (MISSION_CURRENT, common.xml).
  const bool has_home = is_standing_in() && owner_.autopilot == mavlink::mav_autopilot::ardupilotmega;
  if (mission.items == 0) {
    result.total = has_home ? 0 : no_mission_total; // as it says it
    result.mission_state = mavlink::number(mission_state::no_mission);
    return result;
  }
  const bool is_known = progress_ && progress_->plan_id == mission.id;
  const auto state = is_known ? progress_->state : mission_state::not_started;
  const bool is_under_way = state == mission_state::active || state == mission_state::paused;
  auto seq = is_known ? progress_->current : std::uint16_t{0};
  if (start_item_ && state != mission_state::active)
    seq = *start_item_;
  result.total = static_cast<std::uint16_t>(mission.items - (has_home ? 1 : 0));
  result.seq = std::min(seq, static_cast<std::uint16_t>(mission.items - 1));
  result.mission_state = mavlink::number(start_item_ && !is_under_way ? mission_state::not_started : state);
  result.mission_mode = mavlink::number(is_known ? progress_->mode : mavlink::mission_mode::unknown);
  return result;
}

// -- the current item -----------------------------------------------------------------------------

void core::take(decision_context& t, station& from, const mavlink::mission_set_current& m) {
  if (is_for_us(m.target_system, m.target_component))
    choose_current(t, {std::nullopt, from.who, m.seq});
  else
    ++counts_.not_for_us;
}

void core::refuse_current(decision_context& t, const set_current_request& set_current, mav_result result,
                          const std::string& text) {
  ++counts_.commands_refused;
  if (set_current.by_command)
    answer(t, *set_current.by_command, result);
  if (!text.empty())
    t.say(mav_severity::warning, text);
}

void core::choose_current(decision_context& t, const set_current_request& set_current) {
  const auto& mission = shown_[place_of(mav_mission_type::mission)];
  if (set_current.index >= mission.items) {
    refuse_current(t, set_current, mav_result::denied,
                   "Set current: there is no item " + std::to_string(set_current.index));
    return;
  }
  if (const auto objection = object_to(t, set_current.from, "Set current")) {
    refuse_current(t, set_current, objection->result, "Set current: " + objection->why);
    return;
  }
  if (!held_.empty() || is_busy_with_disk()) {
    refuse_current(t, set_current, mav_result::temporarily_rejected, "Set current: a plan is being stored");
    return;
  }
  if (set_current_) {
    const bool is_same = set_current_->from == set_current.from && set_current_->index == set_current.index;
    refuse_current(t, set_current, is_same ? mav_result::in_progress : mav_result::temporarily_rejected,
                   is_same ? "" : "Set current: another item was just asked for");
    return;
  }
  if (static_cast<mission_state>(current().mission_state) != mission_state::active) {
    if (start_item_ == set_current.index) { // nothing to write
      if (set_current.by_command)
        answer(t, *set_current.by_command, mav_result::accepted);
      t.send(io::link::every_peer, current());
      return;
    }
    noted_start_item_ = set_current.index;
    ++waiting_for_disk_;
    start_item_noted event{next_ticket_++, set_current.index, std::nullopt};
    if (set_current.by_command)
      event.ack = vehicle_role::answer_to(*set_current.by_command, mav_result::accepted);
    t.note(std::move(event));
    return;
  }
  if (!has_executor_) {
    refuse_current(t, set_current, mav_result::temporarily_rejected, "Set current: no executor is there");
    return;
  }
  set_current_ = set_current;
  t.done.emplace_back(start_request_to_executor{
      ++set_current_id_, {set_current.index, mission.id, {set_current.from.system, set_current.from.component}}});
}

effects core::on_durable(const start_item_resolved& m, instant now) {
  decision_context t(*this, now);
  if (is_of_this_life(m.ticket))
    note_on_disk();
  if (m.ack && now.wall_ns - m.at_ns < answer_is_worth_ns)
    t.send(mavlink::sender{m.ack->target_system, m.ack->target_component}, *m.ack);
  finish(t);
  return std::move(t.done);
}

effects core::on_current_answer(std::uint64_t request, const executor::current_answer& m, instant now) {
  decision_context t(*this, now);
  if (request == set_current_id_ && set_current_)
    end_set_current(t, result_for(m.verdict),
                    m.verdict == current_verdict::going ? ""
                                                        : "Set current: " + (m.reason.empty() ? "refused" : m.reason));
  finish(t);
  return std::move(t.done);
}

effects core::on_current_failed(std::uint64_t request, const std::string& reason, instant now) {
  decision_context t(*this, now);
  if (request == set_current_id_ && set_current_)
    end_set_current(t, mav_result::temporarily_rejected, "Set current: " + reason);
  finish(t);
  return std::move(t.done);
}

void core::end_set_current(decision_context& t, mav_result result, const std::string& text) {
  const auto set_current = *std::exchange(set_current_, std::nullopt);
  tell_audit(t, set_current.from, "Set current", result == mav_result::accepted ? "taken" : "refused", text);
  if (result != mav_result::accepted) {
    refuse_current(t, set_current, result, text);
    return;
  }
  if (set_current.by_command)
    answer(t, *set_current.by_command, result);
}

// The part of the core that is about mission items which are no part of a plan: an ArduPilot flies to them at once.
//
//   MISSION_ITEM, _INT with current = 2   as DO_REPOSITION, answered by MISSION_ACK
//   with current = 3                      the altitude alone: a person's command
//
// Older stations say "go to" so, QGroundControl its first one. Where a person has the vehicle the item goes on, and the
// vehicle's MISSION_ACK comes back to its station.

namespace {

using executor::act_kind;
using mavlink::mav_mission_result;

constexpr auto item_message = static_cast<std::uint16_t>(mavlink::mission_item::message_id);

} // namespace

// True: it is dealt with.
bool core::route_item(decision_context& t, const mavlink::frame_view& frame) {
  if (owner_.autopilot != mavlink::mav_autopilot::ardupilotmega)
    return false;
  mavlink::mission_item_int item;
  if (frame.id() == mavlink::mission_item_int::message_id)
    item = mavlink::decode<mavlink::mission_item_int>(frame);
  else if (frame.id() == mavlink::mission_item::message_id)
    item = mission_server::in_integers(mavlink::decode<mavlink::mission_item>(frame));
  const bool is_at_once =
      item.current == vehicle_role::item_to_fly_to || item.current == vehicle_role::item_with_altitude;
  if (!is_at_once || item.mission_type != mavlink::number(mavlink::mav_mission_type::mission))
    return false;
  const bool is_go_to =
      item.current == vehicle_role::item_to_fly_to && item.command == mavlink::number(mavlink::mav_cmd::nav_waypoint);
  const auto what = vehicle_role::read_order(frame.from(), item);
  ask(t, {{is_go_to ? act_kind::go_to : act_kind::command, by(frame.from()), is_go_to ? "Go to" : "Altitude"},
          passing::as_said(frame),
          what});
  return true;
}

void core::answer_item(decision_context& t, const vehicle_role::order& what, mav_result result) {
  if (result == mav_result::in_progress)
    return;
  const auto how = result == mav_result::accepted ? mav_mission_result::accepted : mav_mission_result::error;
  t.send_as(stations_.way_to(what.from),
            mavlink::mission_ack{.target_system = what.from.system,
                                 .target_component = what.from.component,
                                 .type = mavlink::number(how)},
            asked_one(what.target_component));
}

void core::note_forwarded_item(mavlink::sender by, std::int64_t now_ns) {
  forwarded_items_.put(by, {item_message, item_message}, 0, now_ns);
}

// Of the vehicle's MISSION_ACKs those alone that answer an item which went on: godwit's own transfers are no station's.
bool core::is_answer_to_item(const vehicle_link::relayed_frame& m, std::int64_t now_ns) {
  const auto ack = mavlink::decode_payload<mavlink::mission_ack>(std::as_bytes(std::span(m.payload)));
  return !forwarded_items_.acknowledge({ack.target_system, ack.target_component}, item_message, now_ns).empty();
}

} // namespace godwit::ground_port
