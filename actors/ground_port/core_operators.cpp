// The part of the core that is about commands of operators. What an order means is in word_reading.hpp, what a
// repetition hears in command_dedup.hpp.
#include <optional>
#include <string>
#include <utility>

#include "actors/ground_port/command_reading.hpp"
#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "io/mavlink/frame_meaning.hpp"

namespace godwit::ground_port {

using mavlink::mav_result;

std::optional<double> core::home_altitude_m() const {
  constexpr double mm_per_m = 1'000;
  const auto& home = gate_.newest(mavlink::home_position::message_id);
  if (!home)
    return std::nullopt;
  return std::get<mavlink::home_position>(*home).altitude / mm_per_m;
}

std::optional<mission::position> core::here() const {
  constexpr double mm_per_m = 1'000;
  const auto& newest = gate_.newest(mavlink::global_position_int::message_id);
  if (!newest)
    return std::nullopt;
  const auto& m = std::get<mavlink::global_position_int>(*newest);
  return mission::position{m.lat / mavlink::units_a_degree, m.lon / mavlink::units_a_degree, m.relative_alt / mm_per_m};
}

// An altitude that a station sends when its hold is answered is that at which the vehicle was when it asked for it.
told_by_vehicle core::told_to(mavlink::sender who, std::int64_t now_ns) const {
  constexpr std::int64_t follows_within_ns = 10'000'000'000; // a hold is answered within seconds
  told_by_vehicle result{owner_.autopilot, home_altitude_m(), here()};
  if (held_from_ && held_from_->by == who && now_ns - held_from_->at_ns < follows_within_ns)
    result.held_from_m = held_from_->altitude_m;
  return result;
}

void core::say_word(decision_context& t, const vehicle_role::order& what) {
  const auto now_ns = t.now.monotonic_ns;
  if (const auto heard = words_.heard_before(what, now_ns))
    return answer(t, what, *heard);
  const auto command = read_word(what, told_to(what.from, now_ns));
  if (!command)
    return refuse(t, what, command.error().result, command.error().text);
  if (command->kind == operators::command_kind::resume && noted_start_item_)
    return start_or_resume(t, what, name_for_people(what)); // at the item that was chosen while it was paused
  begin_word(t, what, *command);
}

void core::say_word_of(decision_context& t, const vehicle_role::order& what, operators::command_kind which) {
  if (const auto heard = words_.heard_before(what, t.now.monotonic_ns))
    return answer(t, what, *heard);
  begin_word(t, what, command_from(what, which));
}

void core::begin_word(decision_context& t, const vehicle_role::order& what, const operators::command& command) {
  const auto now_ns = t.now.monotonic_ns;
  const auto reject_for_now = [&](const std::string& why) {
    refuse(t, what, mav_result::temporarily_rejected, name_for_people(what) + ": " + why);
  };
  const bool is_go_to = command.kind == operators::command_kind::go_to;
  if (!operators::is_stop(command.kind) && is_refused(t, what, is_go_to ? "Go to" : "Continue"))
    return;
  if (!has_executor_)
    return reject_for_now("no executor is there");
  if (!words_.may_begin(what.from, now_ns))
    return reject_for_now("another command is under way");
  t.done.emplace_back(word_to_say{words_.begin(what, now_ns), command});
}

effects core::on_word_answer(std::uint64_t request, const operators::answer& m, instant now) {
  decision_context t(*this, now);
  if (m.is_taken)
    end_word(t, request, mav_result::accepted, {});
  else
    end_word(t, request, mav_result::temporarily_rejected, m.reason.empty() ? "refused" : m.reason);
  finish(t);
  return std::move(t.done);
}

effects core::on_word_failed(std::uint64_t request, const std::string& reason, instant now) {
  decision_context t(*this, now);
  end_word(t, request, mav_result::temporarily_rejected, reason);
  finish(t);
  return std::move(t.done);
}

void core::end_word(decision_context& t, std::uint64_t request, mav_result result, const std::string& reason) {
  const auto asked = words_.resolve(request, result, t.now.monotonic_ns);
  if (!asked)
    return;
  tell_audit(t, asked->from, name_for_people(*asked), result == mav_result::accepted ? "taken" : "refused", reason);
  if (result == mav_result::accepted)
    answer(t, *asked, result);
  else
    refuse(t, *asked, result, name_for_people(*asked) + ": " + reason);
}

// The part of the core that is about who may say what: stations beside operators.
//
//   a station's start, resume, go to, item, plan ──look──> refused with the name of who has control, one row
//                                                  └─────> on its way; one row when it is known what came of it
//   its hold, its return, what a person does by hand: not asked about, and a row of its own (core_passing.cpp)

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

bool core::is_refused(decision_context& t, const station& from, const plan_request& what) {
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
