#include "actors/executor/flight/operator_control.hpp"

#include <utility>

#include "actors/executor/flight/new_run.hpp"
#include "actors/executor/flight/vehicle_steps.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;
using operators::command_kind;

// One that it can fly.
bool holds_our_plan(const state& s) {
  return s.status.cause != pause_cause::foreign_plan && s.status.cause != pause_cause::vehicle_restarted &&
         s.progress.paused != progress::pause_reason::infeasible_plan;
}

bool can_be_stopped(task_kind kind) {
  return brings_plan(kind) || kind == task_kind::start || kind == task_kind::resume;
}

bool needs_vehicle(command_kind what) {
  return what != command_kind::hand_back && what != command_kind::start && what != command_kind::end_flight;
}

} // namespace

// -- a command -----------------------------------------------------------------------------------------

operators::answer operator_control::take(const operators::command& m, bool has_looked, instant now) {
  if (auto why = why_not(m, has_looked); !why.empty())
    return {false, std::move(why)};
  const bool is_own = m.kind == command_kind::resume && has_looked && watch_.may_hand_back({m.system, m.component});
  if (needs_vehicle(m.kind) && flight_.has_person() && !is_own)
    return {false, "the vehicle has to be handed back first: " + flight_.s.status.reason};
  if (flight_.s.status.now == phase::paused && m.kind != command_kind::pause)
    flight_.authority.confirm_hold();
  auto& wanted = flight_.wanted;
  switch (m.kind) {
  case command_kind::hand_back:
    wanted.hand_back = true;
    break;
  case command_kind::start:
    if (is_at_rest(flight_.s.status.now))
      wanted.new_run = true;
    else if (!wanted.start)
      wanted.start.emplace();
    break;
  case command_kind::resume:
    wanted.hand_back = wanted.hand_back || is_own;
    wanted.put_go_on();
    break;
  case command_kind::pause:
    wanted.put_halt(task_kind::hold);
    break;
  case command_kind::come_home:
    wanted.put_halt(task_kind::come_home);
    break;
  case command_kind::end_flight:
    wanted.end_flight = true;
    break;
  default:
    return changes_.take(m, now);
  }
  return {true, {}};
}

// Empty: as far as the command alone goes, it may be said now.
std::string operator_control::why_not(const operators::command& m, bool has_looked) const {
  const auto& view = flight_.view;
  const auto at = flight_.s.status.now;
  const bool drives_plan = view.is_under_way() && view.is_in(mode_kind::mission);
  switch (m.kind) {
  case command_kind::hand_back:
    if (!flight_.has_person())
      return "nobody has taken the vehicle from godwit";
    if (!has_looked || !view.is_connected() || !view.mode())
      return "the vehicle is not heard, so nobody knows who has it; repeat the command when it is";
    return {};
  case command_kind::start:
    if (is_at_rest(at))
      return why_no_new_run(flight_);
    return at == phase::ready ? flight_.why_not_armed() : "the flight is not ready: " + flight_.sentence();
  case command_kind::resume:
    return why_not_resume();
  case command_kind::pause:
  case command_kind::come_home:
    if (!flight_.is_in_flight() && !drives_plan && !flight_.is_starting())
      return "no flight is under way: " + flight_.sentence();
    return {};
  case command_kind::end_flight:
    if (!flight_.keeps_vehicle())
      return "no flight is open: " + flight_.sentence();
    if (view.is_connected() && (view.is_armed() || !view.mode()))
      return "its vehicle is heard and armed: come_home brings it back, or whoever has it lands and disarms it";
    return {};
  default:
    return {};
  }
}

std::string operator_control::why_not_resume() const {
  const auto& doing = flight_.runner.doing();
  const bool is_pausing = doing && doing->kind == task_kind::hold; // then it goes on after that
  if (flight_.s.status.now != phase::paused && !is_pausing)
    return "the flight is not paused: " + flight_.sentence();
  if (flight_.is_in_flight() && !flight_.view.is_under_way())
    return "the vehicle stands on the ground; repeat the command when its flight has ended, in a few seconds";
  if (flight_.is_in_flight() && (flight_.is_plan_finished() || flight_.was_called_home()))
    return "nothing of the mission is left to fly; come_home brings the vehicle back";
  return {};
}

// -- hold, come home --------------------------------------------------------------------------------

// It does not wait for what is under way: that is given up.
bool operator_control::halt(effects& out, instant now) {
  if (flight_.runner.is_busy() && flight_.runner.is_stop())
    return tasks_.run(out, now);
  const auto& doing = flight_.runner.doing();
  if (!flight_.wanted.halt || flight_.has_person() || (doing && !can_be_stopped(doing->kind)))
    return false;
  if (doing)
    return interrupt(out, now);
  begin_halt(out, now);
  return true;
}

bool operator_control::interrupt(effects& out, instant now) {
  const auto& runner = flight_.runner;
  const bool may_move = flight_.is_in_flight() || flight_.view.is_moving() || runner.has_asked_to_start();
  tasks_.give_up(out, now, "an operator has stopped it");
  if (may_move) { // a start may still come through: it is held as what flies
    flight_.was_up = flight_.was_up || flight_.view.is_under_way();
    if (!flight_.is_in_flight())
      phases_.go(out, trigger::started);
    return true;
  }
  flight_.wanted.halt.reset();
  flight_.authority.end();
  phases_.go(out, trigger::start_stopped);
  tasks_.disarm_left_armed(out);
  return true;
}

bool operator_control::flies_our_plan() const {
  return flight_.s.mission && flight_.s.flown && flight_.view.is_under_way() && flight_.view.is_in(mode_kind::mission);
}

void operator_control::begin_halt(effects& out, instant now) {
  if (!flight_.is_in_flight() && flies_our_plan()) { // somebody else has started it: from here on it is a flight
    flight_.adopt_flight();
    return phases_.go(out, trigger::started);
  }
  const auto what = *std::exchange(flight_.wanted.halt, {});
  drop_change(out);
  if (what == task_kind::come_home)
    return returns_.begin(out, now);
  if (is_on_way(flight_.s.status.now))
    phases_.go(out, trigger::told_to_hold);
  tasks_.begin(out, what, {change_mode{mode_kind::hold}});
}

// An operator who says something else waits for the service no longer.
void operator_control::drop_change(effects& out) {
  if (flight_.s.change)
    out.emplace_back(note{change_stopped{flight_.s.change->key}});
}

// -- resume -----------------------------------------------------------------------------------------

// Its own return, to a home that somebody has moved: the rest of the mission leads to the mission's.
bool operator_control::leads_elsewhere() const {
  return going_on_mode(flight_) == mode_kind::returning && flight_.returns_elsewhere();
}

bool operator_control::go_on(effects& out, instant now) {
  if (!flight_.wanted.go_on || flight_.has_open_intent()) // it waits for the end of what was given up
    return false;
  flight_.wanted.go_on = false;
  if (!flight_.is_in_flight()) {
    if (flight_.s.status.now != phase::paused)
      return false;
    flight_.authority.end(); // that of a start that failed
    phases_.go(out, trigger::prepare_again);
    return true;
  }
  drop_change(out);
  if (flight_.was_called_home()) // since it was said
    out.emplace_back(announce{"not resumed: " + why_not_resume(), true});
  else if (!holds_our_plan(flight_.s) || leads_elsewhere())
    changes_.deploy_again(out, now);
  else
    tasks_.begin(out, task_kind::resume, tasks_.guarded(going_on_steps(flight_)));
  return true;
}

} // namespace godwit::executor
