// The part of the core that is about who may say what: stations beside operators.
//
//   a station's start, resume, go to, item, plan ──look──> refused with the name of who has control, one row
//                                                  └─────> on its way; one row when it is known what came of it
//   its hold, its return, what a person does by hand: not asked about, and a row of its own (core_passing.cpp)
#include <string>
#include <utility>

#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"

namespace godwit::ground_port {

using mavlink::mav_result;

effects core::on_control(const operator_bridge::control_news& m, instant now) {
  decision_context t(*this, now);
  rules_.on_control(m.holder);
  finish(t);
  return std::move(t.done);
}

void core::tell_audit(decision_context& t, mavlink::sender who, std::string what, std::string outcome,
                      std::string reason) {
  if (settings_.stations_are)
    t.done.emplace_back(audit_row_to_tell{who, std::move(what), std::move(outcome), std::move(reason)});
}

// Of a stream of sticks, or of many parameters, the beginning.
void core::audit_act(decision_context& t, const passing::waiting_act& what, const std::string& outcome,
                     std::string reason) {
  if (audited_acts_.begins(what.act, outcome, t.now.monotonic_ns))
    tell_audit(t, {what.act.by.system, what.act.by.component}, what.act.what, outcome, std::move(reason));
}

std::optional<station_rules::objection> core::object_to(decision_context& t, mavlink::sender who,
                                                        const std::string& what) {
  auto objection = rules_.look();
  if (objection)
    tell_audit(t, who, what, objection->outcome, objection->why);
  return objection;
}

bool core::is_refused(decision_context& t, const vehicle_role::order& what, const std::string& name) {
  const auto objection = object_to(t, what.from, name);
  if (objection)
    refuse(t, what, objection->result, name + ": " + objection->why);
  return objection.has_value();
}

bool core::is_refused(decision_context& t, const station& from, const plan_wish& what) {
  if (!is_for_us(what.target_system, what.target_component))
    return false;
  const std::string name = what.clears ? "Clear" : "Upload";
  const auto objection = object_to(t, from.who, name);
  const auto why = objection ? objection->why : what.is_part ? why_no_part(from.who, what.mission_type) : std::string();
  if (why.empty())
    return false;
  ++counts_.plans_refused;
  t.send(from.who, mavlink::mission_ack{.target_system = from.who.system,
                                        .target_component = from.who.component,
                                        .type = mavlink::number(mavlink::mav_mission_result::denied),
                                        .mission_type = what.mission_type});
  t.say(mavlink::mav_severity::warning, name + ": " + why);
  return true;
}

// Who knows another plan than this one would change an item that its people have not seen.
std::string core::why_no_part(mavlink::sender who, std::uint8_t mission_type) const {
  using mavlink::mav_mission_type;
  if (mission_type != mavlink::number(mav_mission_type::mission))
    return "only missions are changed in part";
  return views_.shows(who, server_->plan(mav_mission_type::mission).id) ? ""
                                                                        : "download the plan first, it has changed";
}

} // namespace godwit::ground_port
