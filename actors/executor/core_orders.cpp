// Orders that waited for the disk, and what became of orders.
#include <algorithm>
#include <utility>
#include <variant>

#include "actors/executor/core.hpp"
#include "io/mavlink/enums.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor {
namespace {

namespace transfer = vehicle_link::transfer;

// Each part numbers its orders in a range of its own.
enum class order_owner { runner, recovery, clearing, last_line, plan_watch };

order_owner owner_of(std::uint64_t number) {
  if (number >= first_of_plan_watch)
    return order_owner::plan_watch;
  if (number >= first_of_last_line)
    return order_owner::last_line;
  if (number >= first_clearing)
    return order_owner::clearing;
  return number >= first_reading_back ? order_owner::recovery : order_owner::runner;
}

bool finds_other_plan(const effects& what) {
  return std::ranges::any_of(what, [](const effect& each) {
    const auto* const noted = std::get_if<note>(&each);
    return noted != nullptr && std::holds_alternative<progress::other_plan_found>(noted->what);
  });
}

} // namespace

bool core::awaits(std::uint64_t number) const {
  switch (owner_of(number)) {
  case order_owner::plan_watch:
    return plan_.awaits(number);
  case order_owner::last_line:
    return last_line_.awaits(number);
  case order_owner::clearing:
    return clearing_.awaits(number);
  case order_owner::recovery:
    return recovery_.awaits(number);
  case order_owner::runner:
    break;
  }
  return flight_.runner.awaits(number);
}

permission core::may_go_out(const order& what, instant now) {
  effects none;
  switch (owner_of(what.number)) {
  case order_owner::last_line:
    return last_line_.may_go_out() ? permission::may : permission::wait;
  case order_owner::clearing:
    return clearing_.may_go_out() ? permission::may : permission::wait;
  case order_owner::recovery: // they ask for what the vehicle holds, and change nothing
  case order_owner::plan_watch:
    return permission::may;
  case order_owner::runner:
    break;
  }
  return flight_.runner.may_go_out(flight_.world(now, none));
}

core::release core::lets_out(const order& what, instant now) {
  if (GODWIT_PLANTED(let_stale_order_out))
    return release::now;
  if (!awaits(what.number))
    return release::revoked;
  if (flight_.pending.is_pending())
    return release::pending;
  const bool is_old = now.now_ns - what.decided_ns > order_is_worth_ns;
  const auto allowed = may_go_out(what, now);
  if (is_old || flight_.authority.is_unclear() || allowed == permission::not_ours || allowed == permission::wait)
    return release::too_late;
  if (allowed != permission::may)
    return release::outdated;
  if (!what.expected.empty())
    flight_.authority.expect(what.expected, now.now_ns, now.now_ns + flight::order_is_expected_ns);
  return release::now;
}

effects core::on_late(const order& what, instant now) {
  const auto& doing = flight_.runner.doing();
  const bool moves = doing && (doing->kind == task_kind::start || doing->kind == task_kind::resume ||
                               doing->kind == task_kind::await_arming);
  // What lets the vehicle move is not repeated by itself when the disk writes at last: a person may stand there.
  return on_unsent(what, "the journal did not write in time",
                   moves ? vehicle_link::command_verdict::invalid : vehicle_link::command_verdict::not_sent, now);
}

effects core::on_pending(const order& what, instant now) {
  return on_unsent(what, "a command of a station is on its way", vehicle_link::command_verdict::outdated, now);
}

effects core::on_unsent(const order& what, const std::string& why, vehicle_link::command_verdict verdict, instant now) {
  if (std::holds_alternative<failsafe::guard_mission>(what.what))
    return on_guarded(what.number, {false, why}, false, now);
  if (std::holds_alternative<vehicle_link::upload_plan>(what.what) ||
      std::holds_alternative<vehicle_link::download_plan>(what.what)) {
    transfer::outcome outcome;
    outcome.verdict = transfer::verdict::not_begun;
    outcome.holding = transfer::holding::unchanged;
    outcome.reason = why;
    return on_transfer(what.number, outcome, now);
  }
  vehicle_link::command_outcome outcome;
  outcome.verdict = verdict;
  outcome.reason = why;
  return on_command(what.number, outcome, now);
}

// It is decided again, with another look at the vehicle.
effects core::on_outdated(const order& what, instant now) {
  if (std::holds_alternative<vehicle_link::upload_plan>(what.what))
    return on_late(what, now);
  vehicle_link::command_outcome outcome;
  outcome.verdict = vehicle_link::command_verdict::outdated;
  outcome.reason = "it has waited too long after the vehicle was observed";
  return on_command(what.number, outcome, now);
}

// It was given up before it went out, and so nobody answers it.
effects core::on_revoked(const order& what) {
  const auto& doing = flight_.runner.doing();
  const bool is_of_task =
      owner_of(what.number) == order_owner::runner && std::holds_alternative<vehicle_link::upload_plan>(what.what);
  if (!is_of_task || !flight_.s.progress.upload || (doing && brings_plan(doing->kind)))
    return {};
  return {note{flight_.runner.uploads().end_unsent("it was given up")}};
}

effects core::on_command(std::uint64_t number, const vehicle_link::command_outcome& outcome, instant now) {
  effects out;
  const auto& doing = flight_.runner.doing();
  const bool is_hold_accepted = flight_.runner.awaits(number) && doing->kind == task_kind::hold &&
                                outcome.verdict == vehicle_link::command_verdict::accepted;
  lost_state_.on_command(out, number, outcome);
  flight_.runner.on_command(flight_.world(now, out), number, outcome);
  if (is_hold_accepted)
    acts_.on_hold_accepted(out);
  return out;
}

effects core::on_transfer(std::uint64_t number, const transfer::outcome& outcome, instant now) {
  effects out;
  switch (owner_of(number)) {
  case order_owner::plan_watch:
    plan_.on_transfer(out, number, outcome, now);
    if (flight_.was_called_home() && finds_other_plan(out)) // which progress does not follow any more
      lose_plan(out, trigger::foreign_plan_found, now);
    break;
  case order_owner::last_line:
    last_line_.on_transfer(out, number, outcome, now);
    break;
  case order_owner::clearing:
    clearing_.on_transfer(out, number, outcome);
    break;
  case order_owner::recovery:
    recovery_.take_read_back(out, number, outcome, now);
    break;
  case order_owner::runner:
    if (outcome.mission_type == io::mavlink::mav_mission_type::mission)
      stations_.on_transfer(outcome);
    if (flight_.runner.awaits(number))
      flight_.runner.on_transfer(flight_.world(now, out), number, outcome);
    else if (flight_.s.progress.upload) // of a task that was dropped
      out.emplace_back(note{flight_.runner.uploads().end(outcome)});
    break;
  }
  return out;
}

effects core::on_looked(std::uint64_t number, const vehicle_link::looked& what, instant now) {
  effects out;
  flight_.runner.on_looked(flight_.world(now, out), number, what);
  return out;
}

effects core::on_guarded(std::uint64_t number, const failsafe::guard_answer& answer, bool is_answered, instant now) {
  effects out;
  flight_.runner.on_guarded(flight_.world(now, out), number, answer.taken ? std::string() : answer.reason, is_answered);
  return out;
}

} // namespace godwit::executor
