// The part of the core that asks the executor about what a person does by a station, and acts on its answer
// (core_passing.cpp).
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
  auto act = what.act;
  if (!has_executor_)
    return pass_unanswered(t, what, "no executor is there");
  if (const auto request = acts_.put(std::move(what)))
    t.done.emplace_back(act_to_ask{*request, std::move(act)});
}

effects core::on_act_answer(std::uint64_t request, const executor::act_answer& m, instant now) {
  decision_context t(*this, now);
  if (auto asked = acts_.resolve(request)) {
    if (m.verdict == act_verdict::refused) {
      refuse_act(t, *asked, m.reason);
    } else if (m.verdict == act_verdict::pass) {
      audit_act(t, *asked, audited_as_taken, "it goes on to the vehicle");
      pass(t, std::move(asked->frame));
    } else {
      audit_act(t, *asked, audited_as_taken, {});
      if (asked->order)
        answer(t, *asked->order, mav_result::accepted);
    }
    if (m.verdict == act_verdict::done && asked->act.kind == act_kind::hold)
      is_hold_asked_ = true;
  }
  finish(t);
  return std::move(t.done);
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
