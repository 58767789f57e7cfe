// The part of the core that is about commands of stations.
//
//   MISSION_START                    see vehicle_role/mission_start.hpp and command_dedup.hpp
//   DO_REPOSITION, _PAUSE_CONTINUE   see word_reading.hpp and command_dedup.hpp
//   DO_SET_MISSION_CURRENT           out of range DENIED; not running: the start item; running: the executor's
//   REQUEST_MESSAGE, 410, 519, 520   ACCEPTED and the message; DENIED: not one of ours; FAILED: nothing heard yet
//   SET_MESSAGE_INTERVAL             ACCEPTED, or DENIED for what is not forwarded
//   any other to us                  UNSUPPORTED; nothing, when all systems are meant
//   to the autopilot                 nothing: it is not us. The station is told once a minute that none is passed on
#include <limits>
#include <string>
#include <utility>

#include "actors/ground_port/about.hpp"
#include "actors/ground_port/command_reading.hpp"
#include "actors/ground_port/core.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "io/time_units.hpp"

namespace godwit::ground_port {

namespace {

using mavlink::mav_cmd;
using mavlink::mav_result;
using mavlink::mav_severity;

constexpr std::int64_t least_current_interval_us = 100'000; // changes are told at once, whatever is asked for

} // namespace

void core::take(decision_context& t, station& from, const mavlink::command_long& m) { take_command(t, from, m); }
void core::take(decision_context& t, station& from, const mavlink::command_int& m) { take_command(t, from, m); }

template <class M>
void core::take_command(decision_context& t, station& from, const M& m) {
  if (is_for_us(m.target_system, m.target_component))
    obey(t, vehicle_role::read_order(from.who, m), m.target_system == 0);
  else if (m.target_system == autopilot().system && m.target_component == autopilot().component)
    note_foreign_command(t, from);
  else
    ++counts_.not_for_us;
}

void core::note_foreign_command(decision_context& t, station& from) {
  ++counts_.commands_for_autopilot;
  const auto now = t.now.monotonic_ns;
  if (from.told_about_commands_ns && now - *from.told_about_commands_ns < command_notice_period_ns)
    return;
  from.told_about_commands_ns = now;
  t.say(mav_severity::notice, "This port passes no commands to the autopilot", from.peer);
}

void core::obey(decision_context& t, const vehicle_role::order& what, bool is_for_all_systems) {
  switch (what.command) {
  case mavlink::number(mav_cmd::mission_start):
    return start(t, what);
  case mavlink::number(mav_cmd::do_reposition):
  case mavlink::number(mav_cmd::do_pause_continue):
    return say_word(t, what);
  case mavlink::number(mav_cmd::do_set_mission_current): {
    constexpr std::int64_t keep_current = -1;
    const auto index = integer_in(what.param1, keep_current, std::numeric_limits<std::uint16_t>::max());
    if (!index)
      return refuse(t, what, mav_result::denied, "Set current: not an item number");
    const auto wanted = *index == keep_current ? current().seq : static_cast<std::uint16_t>(*index);
    return choose_current(t, {what, what.from, wanted});
  }
  case mavlink::number(mav_cmd::request_message):
    return give_message(t, what, message_id_in(what.param1));
  case mavlink::number(mav_cmd::get_home_position):
    return give_message(t, what, mavlink::home_position::message_id);
  case mavlink::number(mav_cmd::request_protocol_version):
    return give_message(t, what, mavlink::protocol_version::message_id);
  case mavlink::number(mav_cmd::request_autopilot_capabilities):
    return give_message(t, what, mavlink::autopilot_version::message_id);
  case mavlink::number(mav_cmd::set_message_interval): {
    const auto id = message_id_in(what.param1);
    const bool is_set = id && set_interval(*id, what.param2, t.now.monotonic_ns);
    return answer(t, what, is_set ? mav_result::accepted : mav_result::denied);
  }
  default:
    ++counts_.commands_unsupported;
    if (!is_for_all_systems) // what all were asked to do, only those answer who can
      answer(t, what, mav_result::unsupported);
  }
}

// As the one who was asked. SET_MODE has no answer, but of a PX4.
void core::answer(decision_context& t, const vehicle_role::order& what, mav_result result) {
  if (what.is_item)
    return answer_item(t, what, result);
  if (what.command != 0)
    t.send_as(stations_.way_to(what.from), vehicle_role::answer_to(what, result), asked_one(what.target_component));
}

mavlink::sender core::asked_one(std::uint8_t component) const {
  const bool is_autopilot = settings_.passes && !stood_down_ && component == autopilot().component;
  return is_autopilot ? autopilot() : ourselves();
}

void core::refuse(decision_context& t, const vehicle_role::order& what, mav_result result, const std::string& text) {
  ++counts_.commands_refused;
  answer(t, what, result);
  t.say(mav_severity::warning, text);
}

// -- MISSION_START --------------------------------------------------------------------------------

void core::start(decision_context& t, const vehicle_role::order& what) {
  const auto plan_id = server_->plan(mavlink::mav_mission_type::mission).id;
  const auto repetition = starts_.judge(what, plan_id, t.now);
  if (repetition == start_dedup::kind::repeated_while_asked)
    return answer(t, what, mav_result::in_progress);
  if (repetition == start_dedup::kind::repeated_after)
    return answer(t, what, static_cast<mav_result>(starts_.record()->result));
  if (is_refused(t, what, "Mission start"))
    return;
  // In flight it goes on with what is flown.
  if (!is_in_flight() && views_.shows_another(what.from, plan_id))
    return refuse(t, what, mav_result::temporarily_rejected, "Mission start: the plan has changed; load it");
  vehicle_role::start_situation now;
  now.item_count = static_cast<int>(server_->plan(mavlink::mav_mission_type::mission).items.size());
  now.is_transferring = server_->is_receiving() || !held_.empty();
  now.is_armed = true; // armed and ready: the executor knows
  auto decided = vehicle_role::decide_start({what.param1, what.param2}, now);
  if (decided.result != mav_result::accepted)
    return refuse(t, what, decided.result, decided.text);
  if (repetition == start_dedup::kind::busy)
    return refuse(t, what, mav_result::temporarily_rejected, "Mission start: another start is under way");
  if (!has_executor_)
    return refuse(t, what, mav_result::temporarily_rejected, "Mission start: no executor is there");
  // Who has chosen the item to begin with, and then starts from "the first", means that one.
  if (decided.first == 0 && noted_start_item_ && *noted_start_item_ <= decided.last)
    decided.first = *noted_start_item_;
  t.note(start_noted{starts_.begin(what, decided, plan_id, t.now)});
}

effects core::on_start_answer(const executor::start_answer& m, instant now) {
  decision_context t(*this, now);
  if (const auto record = starts_.resolve(m, now))
    t.note(start_noted{*record});
  finish(t);
  return std::move(t.done);
}

effects core::on_durable(const start_resolved& m, instant now) {
  decision_context t(*this, now);
  const auto& record = m.record;
  const auto result = static_cast<mav_result>(record.result);
  if (result == mav_result::accepted) {
    start_item_.reset();
    noted_start_item_.reset();
  } else {
    ++counts_.commands_refused;
  }
  const mavlink::sender to{record.asked.asked_by.system, record.asked.asked_by.component};
  if (!record.is_correction && now.wall_ns - record.resolved_at_ns < answer_is_worth_ns)
    answer(t, {.from = to, .command = record.command, .target_component = record.asked_component}, result);
  t.say(result == mav_result::accepted ? mav_severity::info : mav_severity::warning, record.text);
  if (!record.is_correction)
    tell_audit(t, to, "Mission start", result == mav_result::accepted ? "taken" : "refused", record.text);
  finish(t);
  return std::move(t.done);
}

// -- messages and their rates ---------------------------------------------------------------------

void core::give_message(decision_context& t, const vehicle_role::order& what, std::optional<std::uint32_t> id) {
  const bool is_ours = id && (*id == mavlink::protocol_version::message_id || forwarded_messages::contains(*id));
  if (!is_ours)
    return answer(t, what, mav_result::denied);
  const auto place = t.done.size();
  const bool is_sent = send_message(t, stations_.way_to(what.from), *id);
  answer(t, what, is_sent ? mav_result::accepted : mav_result::failed);
  if (is_sent && t.done.size() == place + 2) // the answer first: a station may wait for it before the message
    std::swap(t.done[place], t.done[place + 1]);
}

bool core::send_message(decision_context& t, io::link::peer_id to, std::uint32_t id) {
  if (id == mavlink::protocol_version::message_id) {
    t.send(to, protocol_to_show());
    return true;
  }
  const auto& newest = gate_.newest(id);
  if (id == mavlink::autopilot_version::message_id) {
    auto version =
        version_to_show(newest ? std::optional(std::get<mavlink::autopilot_version>(*newest)) : std::nullopt);
    if (newest && is_passing(t.now.monotonic_ns)) // what the vehicle can do is reached through us
      version.capabilities |= std::get<mavlink::autopilot_version>(*newest).capabilities;
    t.send(to, version);
    return true;
  }
  if (id == mavlink::mission_current::message_id) {
    t.send(to, current());
    return true;
  }
  if (!newest || is_autopilot_here(t.now.monotonic_ns))
    return false;
  std::visit([&](const auto& message) { t.send_as(to, message, autopilot()); }, *newest);
  return true;
}

bool core::set_interval(std::uint32_t id, float interval_us, std::int64_t now_ns) {
  // Below 2^31, and the largest float there.
  constexpr std::int64_t most_us = std::numeric_limits<std::int32_t>::max() - 127;
  const auto wanted_us = integer_in(interval_us, -1, most_us);
  if (!wanted_us)
    return false;
  if (id != mavlink::mission_current::message_id)
    return gate_.set_interval(id, *wanted_us);
  // MISSION_CURRENT is told at least once a second: stations and failsafes go by it.
  const auto period_ns = *wanted_us == 0 ? vehicle_role::current_report::period_ns : *wanted_us * ns_per_us;
  if (period_ns > vehicle_role::current_report::period_ns || *wanted_us < 0)
    return false;
  report_.set_period(std::max(period_ns, least_current_interval_us * ns_per_us), now_ns);
  return true;
}

} // namespace godwit::ground_port
