#include "actors/executor/flight/stations/station_acts.hpp"

#include <utility>

#include "actors/executor/flight/vehicle_steps.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;

constexpr std::int64_t ns_per_ms = 1'000'000;

bool is_up_next(const station_act& m) { return m.kind == act_kind::arm || m.kind == act_kind::take_off; }

// The oldest gives way.
void await(std::vector<station_act>& waiting, const station_act& m) {
  if (waiting.size() == max_awaited_holds)
    waiting.erase(waiting.begin());
  waiting.push_back(m);
}

void resolve(effects& out, std::vector<station_act>& waiting, const act_answer& answer) {
  for (const auto& each : std::exchange(waiting, {}))
    out.emplace_back(send_to_port{act_resolved{each.number, answer}});
}

} // namespace

act_answer station_acts::take(effects& out, const station_act& m, bool has_looked, instant now) {
  if (auto answer = arming_.take(out, m, now))
    return *std::move(answer);
  if (m.kind == act_kind::configure)
    return configure();
  if (auto answer = hold(m, has_looked, now))
    return *std::move(answer);
  if (m.kind == act_kind::go_on)
    return go_on(m, has_looked, now);
  if (m.kind == act_kind::go_to && !flight_.has_person())
    return {act_verdict::own, {}};
  if (is_armed_already(m))
    return {act_verdict::done, {}};
  return pass(out, m, now);
}

act_answer station_acts::configure() {
  if (!flight_.view.mode() || !flight_.view.is_connected())
    return {act_verdict::refused, "the vehicle is not heard"};
  if (flight_.view.is_armed() || flight_.is_in_flight() || flight_.is_starting())
    return {act_verdict::refused, "not while the vehicle is armed"};
  preparation_.check_again();
  return {act_verdict::pass, {}};
}

act_answer station_acts::pass(effects& out, const station_act& m, instant now) {
  if (!m.is_acknowledged) {
    accept(out, m);
  } else if (takes_vehicle(m) || flight_.awaited_arming) {
    out.emplace_back(send_to_failsafe{failsafe::command_pending{pending_commands::answered_within_ns / ns_per_ms}});
    if (const auto oldest = flight_.pending.begin(m, now.now_ns))
      accept(out, *oldest);
  }
  if (!is_up_next(m))
    ground_.on_act(out);
  else
    flight_.arming_until_ns = now.now_ns + arming_shows_within_ns;
  return {act_verdict::pass, {}};
}

bool station_acts::takes_vehicle(const station_act& m) const {
  const bool stands = flight_.view.mode() && !flight_.view.is_armed() && !flight_.is_in_flight() &&
                      !flight_.is_starting() && !is_up_next(m);
  return !stands || flight_.has_person();
}

// Arm and start in one breath: a start that came before the vehicle has answered the arm of its station hands it back,
// as one that comes after it.
void station_acts::accept(effects& out, const station_act& m) {
  flight_.awaited_arming.reset();
  if (!takes_vehicle(m))
    return;
  auto& start = flight_.wanted.start;
  const bool is_own = is_up_next(m) && start && start->asked && start->asked->asked_by == m.by;
  auto kept = is_own ? std::exchange(start, {}) : std::nullopt;
  watch_.give_to_station(out, m);
  if (!kept)
    return;
  start = std::move(kept);
  flight_.wanted.hand_back = true;
}

void station_acts::on_acknowledged(effects& out, const act_acknowledged& m) {
  const bool was_pending = flight_.pending.is_pending();
  if (const auto accepted = flight_.pending.acknowledge(m))
    accept(out, *accepted);
  else if (was_pending && !flight_.pending.is_pending())
    out.emplace_back(send_to_failsafe{failsafe::command_pending{}});
}

// -- hold -------------------------------------------------------------------------------------------

// Before a flight there is nothing to pause: the vehicle is told to hold, as on a direct line.
std::optional<act_answer> station_acts::hold(const station_act& m, bool has_looked, instant now) {
  if (m.kind != act_kind::hold || flight_.has_person() || !flight_.is_in_flight())
    return std::nullopt;
  const bool holds_already = is_holding();
  operators::command command;
  command.kind = operators::command_kind::pause;
  if (!operators_.take(command, has_looked, now).is_taken)
    return std::nullopt;
  if (holds_already)
    return act_answer{act_verdict::done, {}};
  await(awaited_holds_, m);
  return act_answer{act_verdict::begun, {}};
}

// Nothing that was sent may lead out of it.
bool station_acts::is_holding() const {
  return flight_.s.status.now == phase::paused && !flight_.runner.is_busy() && !flight_.wanted.go_on &&
         flight_.view.mode() && flight_.view.is_connected() && flight_.view.obeys(mode_kind::hold);
}

bool station_acts::is_asked_to_hold() const {
  const auto& doing = flight_.runner.doing();
  return flight_.wanted.halt == task_kind::hold || (doing && doing->kind == task_kind::hold);
}

void station_acts::on_hold_accepted(effects& out) { resolve(out, awaited_holds_, {act_verdict::done, {}}); }

// -- go on ------------------------------------------------------------------------------------------

bool station_acts::is_going_on() const {
  const auto at = flight_.s.status.now;
  return (at == phase::flying || at == phase::landing) && !flight_.runner.is_busy() && flight_.view.mode() &&
         flight_.view.is_connected() && flight_.view.is_in(going_on_mode(flight_));
}

// What is brought about already is not asked for twice.
act_answer station_acts::go_on(const station_act& m, bool has_looked, instant now) {
  if (is_going_on() && !flight_.has_person())
    return {act_verdict::done, {}};
  if (awaited_goings_on_.empty()) {
    operators::command command;
    command.kind = operators::command_kind::resume;
    command.by = name_of(m.by);
    command.system = m.by.system;
    command.component = m.by.component;
    if (auto answer = operators_.take(command, has_looked, now); !answer.is_taken)
      return {act_verdict::refused, std::move(answer.reason)};
  }
  await(awaited_goings_on_, m);
  return {act_verdict::begun, {}};
}

void station_acts::resolve_goings_on(effects& out) {
  const auto& wanted = flight_.wanted;
  const bool is_done = is_going_on() && !flight_.has_person();
  const bool is_under_way = wanted.go_on || wanted.hand_back || flight_.runner.is_busy() || flight_.has_open_intent();
  if (awaited_goings_on_.empty() || (is_under_way && !is_done))
    return;
  const auto answer = is_done ? act_answer{act_verdict::done, {}}
                              : act_answer{act_verdict::refused, "the vehicle does not go on: " + flight_.sentence()};
  resolve(out, awaited_goings_on_, answer);
}

// -- what has come of them --------------------------------------------------------------------------

// One at a time: what a note leads to is decided when it is applied.
void station_acts::look(effects& out, instant now) {
  resolve_goings_on(out);
  if (const auto silent = flight_.pending.take_silent(now.now_ns))
    return accept(out, *silent);
  const bool may_hold = flight_.is_in_flight() && !flight_.has_person();
  if (awaited_holds_.empty() || (may_hold && is_asked_to_hold()))
    return;
  const auto what = std::move(awaited_holds_.front());
  awaited_holds_.erase(awaited_holds_.begin());
  auto answer = act_answer{act_verdict::refused, "the vehicle did not execute the command: " + flight_.sentence()};
  if (!may_hold)
    answer = pass(out, what, now);
  else if (flight_.view.mode() && flight_.view.obeys(mode_kind::hold))
    answer = {act_verdict::done, {}};
  out.emplace_back(send_to_port{act_resolved{what.number, std::move(answer)}});
}

// -- arm --------------------------------------------------------------------------------------------

bool station_acts::is_armed_already(const station_act& m) const {
  return m.kind == act_kind::arm && !flight_.has_person() && flight_.view.is_armed() &&
         (flight_.is_in_flight() || flight_.is_starting());
}

} // namespace godwit::executor
