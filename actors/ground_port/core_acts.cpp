// The part of the core that asks the executor about what a person does by a station, and acts on its answer
// (core_passing.cpp).
#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "actors/ground_port/passing/as_said.hpp"
#include "actors/ground_port/passing/file_transfer.hpp"

namespace godwit::ground_port {

namespace {

using executor::act_kind;
using executor::act_verdict;
using mavlink::mav_result;
using mavlink::mav_severity;
using passing::as_said;
using vehicle_link::relayed_frame;

constexpr const char* audited_as_taken = "taken";

// It ends what the vehicle does, or a person has the sticks: it goes on also where the executor is silent.
bool goes_on_unanswered(act_kind kind) {
  return kind == act_kind::stop || kind == act_kind::hold || kind == act_kind::stream;
}

} // namespace

executor::station core::by(mavlink::sender who) { return {who.system, who.component}; }

void core::ask(decision_context& t, passing::waiting_act what) {
  what.act.is_acknowledged = what.order && !what.order->is_item; // by a COMMAND_ACK
  auto act = what.act;
  if (!has_executor_)
    return pass_unanswered(t, what, "no executor is there");
  if (const auto request = acts_.put(std::move(what))) {
    act.number = *request;
    t.done.emplace_back(act_to_ask{*request, std::move(act)});
  }
}

// It is godwit's to do, and answered when the vehicle is in its mission: no frame of the station's goes on.
void core::ask_to_go_on(decision_context& t, const vehicle_role::order& what, const std::string& name) {
  relayed_frame none;
  none.message = mavlink::command_long::message_id;
  none.system = what.from.system;
  none.component = what.from.component;
  ask(t, {{act_kind::go_on, by(what.from), name}, std::move(none), what});
}

effects core::on_act_answer(std::uint64_t request, const executor::act_answer& m, instant now) {
  decision_context t(*this, now);
  if (auto asked = acts_.resolve(request))
    act_on_answer(t, *std::move(asked), m);
  finish(t);
  return std::move(t.done);
}

effects core::on_act_resolved(const executor::act_resolved& m, instant now) {
  decision_context t(*this, now);
  const auto found = std::ranges::find(begun_acts_, m.number, &passing::waiting_act::request);
  if (found != begun_acts_.end()) {
    auto begun = std::move(*found);
    begun_acts_.erase(found);
    act_on_answer(t, std::move(begun), m.answer);
  }
  finish(t);
  return std::move(t.done);
}

// A station hears ACCEPTED when the vehicle is so, or has accepted it itself.
void core::act_on_answer(decision_context& t, passing::waiting_act asked, const executor::act_answer& m) {
  switch (m.verdict) {
  case act_verdict::refused:
    return refuse_act(t, asked, m.reason);
  case act_verdict::pass:
    audit_act(t, asked, audited_as_taken, "it goes on to the vehicle");
    return forward(t, std::move(asked));
  case act_verdict::begun:
    is_hold_asked_ = is_hold_asked_ || asked.act.kind == act_kind::hold;
    return begin_act(t, std::move(asked));
  case act_verdict::own:
    if (asked.order)
      obey(t, *asked.order, false);
    return;
  case act_verdict::done:
    is_hold_asked_ = is_hold_asked_ || asked.act.kind == act_kind::hold;
    audit_act(t, asked, audited_as_taken, {});
    if (asked.order)
      answer(t, *asked.order, mav_result::accepted);
    return;
  }
}

// A repetition takes the place of the first: the executor may have crashed, and knows of the last one alone. What takes
// longer than a hold hears that it is under way.
void core::begin_act(decision_context& t, passing::waiting_act asked) {
  const auto repeated = std::erase_if(begun_acts_, [&](const passing::waiting_act& each) {
    return each.act.by == asked.act.by && each.act.kind == asked.act.kind && each.frame.message == asked.frame.message;
  });
  if (repeated > 0 && asked.act.kind == act_kind::go_on && asked.order)
    answer(t, *asked.order, mav_result::in_progress);
  if (begun_acts_.size() == max_begun_acts)
    begun_acts_.erase(begun_acts_.begin());
  audit_act(t, asked, audited_as_taken, {});
  begun_acts_.push_back(std::move(asked));
}

// Its COMMAND_ACK is matched here, once: the executor goes by what comes of it.
void core::forward(decision_context& t, passing::waiting_act what) {
  if (what.act.is_acknowledged && what.order) {
    const bool is_set_mode = what.frame.message == mavlink::set_mode::message_id;
    const auto command = is_set_mode ? mavlink::number(mavlink::mav_cmd::do_set_mode) : what.order->command;
    const auto as_message = static_cast<std::uint16_t>(mavlink::set_mode::message_id); // ArduPilot's number for it
    forwarded_.put(what.order->from, {command, is_set_mode ? as_message : command}, what.request, t.now.monotonic_ns);
  }
  if (what.order && what.order->is_item)
    note_forwarded_item(what.order->from, t.now.monotonic_ns);
  is_mode_known_ = false;
  pass(t, std::move(what.frame));
}

// Of the autopilot alone: that a camera does not know a command for all components says nothing of the vehicle.
void core::on_acknowledgement(decision_context& t, const relayed_frame& m) {
  if (mavlink::sender{m.system, m.component} != autopilot() || m.payload.empty())
    return;
  const auto ack = mavlink::decode_payload<mavlink::command_ack>(std::as_bytes(std::span(m.payload)));
  const auto result = static_cast<mav_result>(ack.result);
  const bool is_refused = result != mav_result::accepted && result != mav_result::in_progress;
  for (const auto number :
       forwarded_.acknowledge({ack.target_system, ack.target_component}, ack.command, t.now.monotonic_ns))
    t.done.emplace_back(acknowledgement_to_tell{{number, is_refused}});
}

effects core::on_act_failed(std::uint64_t request, const std::string& reason, instant now) {
  decision_context t(*this, now);
  if (const auto asked = acts_.resolve(request))
    pass_unanswered(t, *asked, reason);
  finish(t);
  return std::move(t.done);
}

// The failsafe hears it before the vehicle does, and a new executor from the failsafe.
void core::pass_unanswered(decision_context& t, const passing::waiting_act& what, const std::string& reason) {
  ++counts_.acts_unanswered;
  if (!goes_on_unanswered(what.act.kind))
    return refuse_act(t, what, reason);
  t.done.emplace_back(tell_taken_over{});
  pass(t, what.frame);
  audit_act(t, what, audited_as_taken, "it goes on to the vehicle although " + reason);
  if (what.act.kind != act_kind::stream)
    t.say(mav_severity::critical, what.act.what + " is passed on although " + reason);
}

void core::refuse_act(decision_context& t, const passing::waiting_act& what, const std::string& reason) {
  ++counts_.passing_refused;
  audit_act(t, what, "refused", reason);
  const mavlink::sender to{what.frame.system, what.frame.component};
  if (what.order)
    answer(t, *what.order, mav_result::temporarily_rejected);
  else if (what.frame.message == file_transfer_id)
    refuse_file(t, what.frame);
  else if (what.frame.message == mavlink::param_set::message_id)
    read_back(t, what.frame);
  if (what.act.kind != act_kind::stream)
    t.say(mav_severity::warning, what.act.what + ": " + reason, stations_.way_to(to));
}

// The value that stays is the answer to a parameter that is not set.
void core::read_back(decision_context& t, const relayed_frame& asked) {
  if (asked.payload.empty()) // all zeros, which some programs cut off: it names no parameter
    return;
  const auto m = mavlink::decode_payload<mavlink::param_set>(std::as_bytes(std::span(asked.payload)));
  mavlink::param_request_read set_current;
  set_current.target_system = m.target_system;
  set_current.target_component = m.target_component;
  set_current.param_id = m.param_id;
  set_current.param_index = -1;
  pass(t, as_said(set_current, {asked.system, asked.component}));
}

} // namespace godwit::ground_port
