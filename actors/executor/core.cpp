#include "actors/executor/core.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "actors/domain/vehicle_text/vehicle_text.hpp"
#include "actors/executor/flight/new_run.hpp"
#include "actors/executor/progress/acts.hpp"
#include "actors/executor/state_token.hpp"
#include "io/mavlink/enums.hpp"
#include "runtime/planted_bug.hpp"

namespace godwit::executor {
namespace {

namespace transfer = vehicle_link::transfer;

constexpr std::int64_t check_period_ns = 1'000'000'000;

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

// -- the arbiter ------------------------------------------------------------------------------------

// The first that has something to do keeps the others waiting. Above: who has the vehicle, and words that stop it.
const std::array<core::rule, 18> core::rules{
    &core::look,              // a new incarnation, at the vehicle
    &core::heed,              // somebody else has it, or may have
    &core::come_home,         // around the fences
    &core::halt,              // hold, come home
    &core::resolve,           // what became of an upload or a start without an answer
    &core::run_task,          // the one under way
    &core::end_flight,        // the vehicle is down
    &core::stand_by,          // left in its mission mode, disarmed
    &core::keep_home,         // where a return leads
    &core::answer_assignment, // of the service
    &core::fly_unanswered,    // a change that the service has not answered
    &core::deploy_arrived,    // a new revision, in flight
    &core::follow_started,    // our plan is flown, and nobody here has started it
    &core::take_back,         // an operator has handed the vehicle back
    &core::leave_to_person,   // nothing below is done while somebody else has it
    &core::bring_last_line,   // fences and rally points, behind a plan that is ready
    &core::begin_wanted,      // what was begun before, a new run, a change, resume, start
    &core::prepare,           // the next flight, on the ground
};

effects core::on_start(bool is_new_process) {
  recovery_.begin(is_new_process);
  auto out = on_client_back();
  out.emplace_back(watch_vehicle{false}); // the incarnation before may have begun a start
  if (flight_.s.preflight.now != preflight::phase::idle)
    out.emplace_back(note{preflight::restarted{}});
  return out;
}

effects core::on_client_back() {
  const auto& s = flight_.s;
  effects out;
  service_.forget_told();
  if (const auto id = service_.mission_under_way(); !id.empty())
    out.emplace_back(say_to_client{mission_client::begin_mission{id}});
  const bool has_ended = s.status.now == phase::post_flight || s.status.now == phase::aborted;
  if (flight_.configured.has_service && has_ended && s.mission)
    out.emplace_back(say_to_client{mission_client::push_map{s.mission->mission_id}});
  return out;
}

std::int64_t core::next_deadline_ns(instant now) const {
  auto next_ns =
      std::min({flight_.runner.next_deadline_ns(), homecoming_.next_deadline_ns(), now.now_ns + check_period_ns / 2});
  if (changes_.next_deadline_ns() > now.now_ns) // past it, it waits for the vehicle
    next_ns = std::min(next_ns, changes_.next_deadline_ns());
  return next_ns;
}

// What follows from a note is decided when it is applied.
effects core::advance(instant now) {
  effects out;
  service_.ask_again(out, now);
  standstill_.look(out, now);
  ground_.on_task();
  changes_.keep_commanded(out, recovery_.has_looked(), now);
  plan_.check(out, now);
  for (const auto& each : messages_.look(out, now.now_ns))
    flight_.view.take(each, now.now_ns);
  parts_.give_up_late(out, now);
  arming_.look(out, now);
  acts_.look(out, now);
  clearing_.look(out, recovery_.has_looked(), now);
  if (stations_.look(out, now))
    return out;
  if (end_.end_by_person(out, now))
    return out;
  homecoming_.answer_failsafe(out, recovery_.has_looked(), now);
  for (bool goes_on = true; goes_on;) {
    const auto before = out.size();
    static_cast<void>(std::ranges::any_of(rules, [&](rule each) { return (this->*each)(out, now); }));
    const bool has_notes =
        std::ranges::any_of(out, [](const effect& each) { return std::holds_alternative<note>(each); });
    goes_on = out.size() != before && !has_notes;
  }
  ground_.on_task();
  return out;
}

bool core::leave_to_person(effects& out, instant) {
  if (!flight_.has_person())
    return false;
  start_.refuse(out, flight_.s.status.reason);
  return true;
}

bool core::begin_wanted(effects& out, instant now) {
  return recovery_.finish(out) || begin_new_run(flight_, out, now) || changes_.bring_plan_before(out, now) ||
         changes_.bring_return_anew(out, now) || changes_.begin_wanted(out, now) || operators_.go_on(out, now) ||
         start_.begin_wanted(out, now);
}

bool core::prepare(effects& out, instant now) {
  const auto came = preparation_.advance(out, now);
  return came == preparation::result::under_way ||
         (came == preparation::result::ready && start_.begin_by_itself(out, now));
}

// -- the vehicle ------------------------------------------------------------------------------------

effects core::on_vehicle(const vehicle_link::connection_changed& m, instant) {
  flight_.view.take(m);
  return {};
}

effects core::on_vehicle(const vehicle_link::vehicle_restarted&, instant) {
  effects out;
  if (progress::matters(flight_.s.progress, progress::vehicle_rebooted{}, 0))
    out.emplace_back(note{progress::vehicle_rebooted{}});
  return out;
}

effects core::on_vehicle(const vehicle_link::foreign_act& m, instant) {
  effects out;
  watch_.on_foreign(m);
  if (m.kind != vehicle_link::foreign_kind::plan)
    ground_.on_act(out);
  return out;
}

effects core::on_vehicle(const io::mavlink::global_position_int& m, instant now) {
  flight_.view.take(m, now.now_ns);
  plan_.on_position(now);
  return {};
}

effects core::on_vehicle(const io::mavlink::heartbeat& m, instant now) {
  flight_.view.take(m, now.now_ns);
  flight_.was_up = flight_.was_up || flight_.view.is_under_way();
  end_.on_heartbeat(now);
  effects out;
  if (recovery_.has_looked()) {
    watch_.on_mode(now);
    ground_.on_mode(out, now);
  }
  return out;
}

effects core::on_vehicle(const io::mavlink::current_mode& m, instant now) {
  flight_.view.take(m);
  effects out;
  if (recovery_.has_looked() && flight_.view.mode()) {
    watch_.on_current_mode(m.intended_custom_mode, now);
    ground_.on_mode(out, now);
  }
  return out;
}

effects core::on_vehicle(const io::mavlink::mission_current& m, instant now) {
  flight_.view.take(m, now.now_ns);
  watch_.on_place(now);
  const auto& s = flight_.s;
  effects out;
  progress::current_told told{m, !flight_.view.is_armed(), !flight_.has_person() && flight_.authority.is_ours(), {}};
  const bool believes_all = GODWIT_PLANTED(complete_on_foreign_landing);
  told.is_ours = told.is_ours || believes_all;
  if (flight_.view.says_complete() && !flight_.is_complete_credible(now) && !believes_all)
    told.message.mission_state = io::mavlink::number(io::mavlink::mission_state::active);
  if (s.progress.plan && told.is_ours)
    told.never_near =
        plan_.never_near(m.seq, told.message.mission_state == io::mavlink::number(io::mavlink::mission_state::complete)
                                    ? plan_watch::told::complete
                                    : plan_watch::told::at);
  if (s.progress.plan && progress::matters(s.progress, told, now.wall_ns))
    out.emplace_back(note{told});
  return out;
}

effects core::on_vehicle(const io::mavlink::mission_item_reached& m, instant now) {
  const auto& s = flight_.s;
  const bool is_early = flight_.ends_on_ground() && m.seq >= end_of_plan(flight_.view.owner(), s).from_sequence &&
                        !flight_.came_down_as_planned(now);
  effects out;
  progress::reached_told told{m.seq, {}};
  if (!is_early && s.progress.plan)
    told.never_near = plan_.never_near(m.seq, plan_watch::told::reached);
  if (!is_early)
    note_of_mission(out, told, now);
  return out;
}

effects core::on_vehicle(const io::mavlink::statustext& m, instant now) {
  // That a person takes the vehicle does not wait for the rest of a text.
  flight_.authority.on_text(flight_.view.owner(), flight::text_of(m), now.now_ns);
  if (flight::tells_new_plan(flight::text_of(m)) && !flight_.s.progress.upload)
    flight_.evidence.plan.doubt(now.now_ns);
  effects out;
  for (const auto& each : messages_.take(out, m, now.now_ns)) {
    flight_.view.take(each, now.now_ns);
    if (const auto act = progress::act_in(each.text))
      note_of_mission(out, *act, now);
  }
  return out;
}

// Not while anybody else has the vehicle: what it does then is no progress of the mission.
void core::note_of_mission(effects& out, const progress::event& what, instant now) {
  const auto& s = flight_.s;
  if (!flight_.has_person() && flight_.authority.is_ours() && s.progress.plan &&
      progress::matters(s.progress, what, now.wall_ns))
    std::visit([&](const auto& each) { out.emplace_back(note{each}); }, what);
}

effects core::on_vehicle(const vehicle_link::picture_taken& m, instant now) {
  effects out;
  note_of_mission(out, progress::picture_told{m.index, m.is_good}, now);
  return out;
}

effects core::on_vehicle(const io::mavlink::sys_status& m, instant now) {
  flight_.view.take(m);
  return energy_.on_battery(now);
}

effects core::on_vehicle(const io::mavlink::home_position& m, instant now) {
  flight_.view.take(m, now.now_ns);
  auto out = return_place_.on_home();
  ground_.on_home(out, now);
  return out;
}

// -- orders that waited for the disk, and what became of orders -------------------------------------

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
    flight_.authority.expect(what.expected, now.now_ns + flight::order_is_expected_ns);
  return release::now;
}

effects core::on_late(const order& what, instant now) {
  const auto& doing = flight_.runner.doing();
  const bool moves = doing && (doing->kind == task_kind::start || doing->kind == task_kind::resume ||
                               doing->kind == task_kind::await_arming);
  // What lets the vehicle move is not said again by itself when the disk writes at last: a person may stand there.
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
  outcome.reason = "it has waited too long after the vehicle was looked at";
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

// -- people -----------------------------------------------------------------------------------------

effects core::on_station(const plan_cleared& m, instant now) {
  auto out = last_line_.stop(); // the vehicle is cleared in its place
  const auto more = stations_.on_cleared(m, recovery_.has_looked(), now);
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

operators::answer core::on_operator(const operators::command& m, instant now) {
  using operators::command_kind;
  if (auto stands = state_token(flight_.s); !m.state.empty() && m.state != stands && !operators::is_stop(m.kind))
    return {false, "the flight stands otherwise by now: " + sentence(), std::move(stands)};
  if (m.kind == command_kind::acknowledge)
    preparation_.acknowledge({m.report, m.by});
  else if (m.kind == command_kind::check)
    preparation_.check_again();
  else if (m.kind == command_kind::pull) {
    auto why = service_.pull();
    return {why.empty(), std::move(why)};
  } else
    return operators_.take(m, recovery_.has_looked(), now);
  return {true, {}};
}

// What is paused, or is to be, stays so: whoever chooses an item has not said that it goes on.
effects core::on_station(const set_current& m, std::uint64_t key, instant now) {
  const auto at = flight_.s.status.now;
  if (flight_.is_in_flight() && at != phase::paused && at != phase::pausing)
    return stations_.on_start({key, m.index, std::numeric_limits<std::uint16_t>::max(), m.plan_id, m.asked_by,
                               now.wall_ns + order_is_worth_ns},
                              now);
  effects out;
  tasks_.answer_start(out, key, start_verdict::not_ready,
                      flight_.is_in_flight() ? "the flight is paused; resume it first" : "the mission does not run");
  return out;
}

std::pair<effects, act_answer> core::on_station(const station_act& m, instant now) {
  effects out;
  auto answer = acts_.take(out, m, recovery_.has_looked(), now);
  return {std::move(out), std::move(answer)};
}

effects core::on_station(const act_acknowledged& m, instant) {
  effects out;
  acts_.on_acknowledged(out, m);
  return out;
}

// -- what a note has led to -------------------------------------------------------------------------

effects core::on_news(const progress::look_at_vehicle& m, instant now) {
  recovery_.on_news(m, now);
  return {};
}

effects core::on_news(const progress::read_plan_back& m, instant now) {
  recovery_.on_news(m, now);
  return {};
}

effects core::on_news(const progress::resolve_start& m, instant now) {
  recovery_.on_news(m, now);
  return {};
}

// Who has the vehicle still has it; after the hand-back the plan counts. What is over stays so: its plan is not needed
// any more, and somebody else's is not replaced without a word. What would fly the vehicle's plan is given
// up, but for a start that may have come through.
void core::lose_plan(effects& out, trigger what, instant now) {
  if (what != trigger::foreign_plan_found && is_over(flight_.s.status.now))
    return;
  const bool is_infeasible = what == trigger::infeasible_plan_found;
  const std::string why = is_infeasible ? "the vehicle finds that the plan can not be flown"
                                        : "the vehicle does not hold our plan any more";
  if (flight_.has_person() && is_infeasible && flight_.view.is_in(flight::mode_kind::hold))
    out.emplace_back(announce{why + ": that it holds may be its own doing, and no pilot's", true});
  if (flight_.has_person())
    return;
  const auto& runner = flight_.runner;
  const auto kind = runner.doing() ? runner.doing()->kind : task_kind::stand_by;
  const bool flies_it = kind == task_kind::resume || kind == task_kind::await_arming ||
                        (kind == task_kind::start && !runner.has_asked_to_start());
  if (flies_it)
    tasks_.give_up(out, now, why);
  flight_.wanted.go_on = false;
  start_.refuse(out, why);
  phases_.go(out, what);
  if (flies_it && flight_.is_left_armed() && !flight_.is_in_flight())
    tasks_.begin(out, task_kind::stand_down, {disarm{}});
}

effects core::on_news(const progress::progress_event& m, instant now) {
  using progress::progress_event_kind;
  effects out;
  switch (m.kind) {
  case progress_event_kind::not_at_start:
    flight_.wanted.set_current_item = m.generation == flight_.s.progress.last_generation;
    break;
  case progress_event_kind::foreign_plan:
    lose_plan(out, trigger::foreign_plan_found, now);
    break;
  case progress_event_kind::infeasible_plan:
    lose_plan(out, trigger::infeasible_plan_found, now);
    break;
  case progress_event_kind::vehicle_restarted:
    lose_plan(out, trigger::autopilot_restarted, now);
    break;
  case progress_event_kind::plan_done:
  case progress_event_kind::mission_complete:
    if (flight_.is_in_flight() && flight_.s.status.now == phase::flying)
      phases_.go(out, trigger::plan_done);
    break;
  case progress_event_kind::act_failed:
  case progress_event_kind::pictures_missing:
    out.emplace_back(announce{m.reason, true});
    break;
  case progress_event_kind::place_missed:
    out.emplace_back(announce{plan_.missed_sentence(m.reason), true});
    flight_.evidence.plan.doubt(now.now_ns);
    break;
  case progress_event_kind::generation_opened:
  case progress_event_kind::armed:
  case progress_event_kind::upload_failed:
    break;
  }
  return out;
}

} // namespace godwit::executor
