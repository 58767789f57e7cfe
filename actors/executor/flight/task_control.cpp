#include "actors/executor/flight/task_control.hpp"

#include <utility>

#include "actors/domain/uuid/uuid.hpp"
#include "actors/executor/flight/mission_list.hpp"
#include "actors/executor/flight/vehicle_steps.hpp"
#include "actors/executor/remaining.hpp"
#include "io/mavlink/plan_meaning.hpp"

namespace godwit::executor {

using flight::mode_kind;

namespace {

constexpr std::size_t max_announced_notes = 8; // of one plan: more than anyone reads at once

deployment deployment_of(const state& s, const mission::document& mission, const plan::flight_plan& what) {
  deployment result;
  if (s.status.in_flight)
    result.left = survey_left(s);
  result.mission = mission;
  result.items = what.items;
  result.landing_sequence = what.landing_sequence;
  result.surveys = what.surveys;
  return result;
}

// What people should know of a plan that is brought.
void announce_notes(effects& out, const plan::flight_plan& what) {
  for (std::size_t i = 0; i < what.notes.size() && i < max_announced_notes; ++i)
    out.emplace_back(announce{what.notes[i], true});
  if (what.notes.size() > max_announced_notes)
    out.emplace_back(announce{"and " + std::to_string(what.notes.size() - max_announced_notes) +
                                  " further notes of this kind on the plan",
                              true});
}

} // namespace

void task_control::answer_start(effects& out, std::uint64_t key, start_verdict verdict, const std::string& reason) {
  out.emplace_back(note{start_resolved{{key, verdict, reason}}});
}

// -- the beginning ----------------------------------------------------------------------------------

void task_control::begin(effects& out, task_kind kind, steps way, bool goes_on, std::optional<std::uint64_t> key) {
  const task what{flight_.s.last_task + 1, kind, goes_on, key};
  out.emplace_back(note{task_begun{what, {}}});
  flight_.runner.begin(what, std::move(way), {});
  if (std::exchange(gave_up_order_, false))
    flight_.runner.ask_all_the_same();
}

void task_control::begin_deploy(effects& out, const mission::document& mission, const plan::flight_plan& what,
                                const std::optional<std::string>& assignment, bool goes_on) {
  announce_notes(out, what);
  begin_plan(out, {flight_.s.last_task + 1, task_kind::deploy, goes_on, {}}, deployment_of(flight_.s, mission, what),
             what.map, assignment);
}

void task_control::begin_bring_back(effects& out, const mission::document& mission, const plan::flight_plan& what) {
  brings_back_ = true;
  begin_deploy(out, mission, what, {}, false);
}

void task_control::begin_part(effects& out, const station_plan_taken& part, const plan::flight_plan& what,
                              std::uint64_t key) {
  auto brings = deployment_of(flight_.s, part.mission, what);
  brings.station = part.plan;
  announce_notes(out, what);
  begin_plan(out, {flight_.s.last_task + 1, task_kind::deploy, true, key}, std::move(brings), what.map);
}

void task_control::begin_upload(effects& out, const station_plan_taken& next, const plan::flight_plan& what) {
  auto brings = deployment_of(flight_.s, next.mission, what);
  brings.station = next.plan;
  brings.is_upload = true;
  announce_notes(out, what);
  begin_plan(out, {flight_.s.last_task + 1, task_kind::deploy, false, {}}, std::move(brings), what.map);
}

void task_control::begin_way_home(effects& out, const plan::flight_plan& what) {
  begin_plan(out, {flight_.s.last_task + 1, task_kind::come_home_by_plan, true, {}},
             deployment_of(flight_.s, *flight_.s.mission, what), what.map);
}

void task_control::begin_plan(effects& out, const task& doing, deployment brings, const progress::plan_map& map,
                              const std::optional<std::string>& assignment) {
  progress::upload_intended intent{brings.mission.revision, map, {}, {}};
  if (flight_.view.keeps_plan_ids() && flight_.view.current())
    intent.id_before = flight_.view.current()->mission_id;
  const auto& view = flight_.view;
  const auto& flown = flight_.s.flown;
  if (flight_.is_in_flight() && flown)
    brings.home = flown->home;
  else if (!flight_.is_in_flight() && view.stands_at_home(view.place_heard_ns())) // as it was heard last
    brings.home = plan::place_of(*view.home());
  if (assignment)
    intent.assignment =
        progress::assignment_key{*assignment, ids::derived_uuid(*assignment, brings.mission.mission_id)};
  const bool is_same = flown && !io::mavlink::first_difference(flown->items, brings.items, flight_.plan_has_home());
  out.emplace_back(note{task_begun{doing, std::move(brings)}});
  flight_.wanted.set_current_item = false;
  flight_.wanted.finish_replan = flight_.wanted.finish_replan && !doing.goes_on;
  deploying_over_ = flight_.s.progress.last_generation;
  deploys_after_end_ = flight_.is_plan_finished();
  flight_.runner.begin(doing, deploy_steps(flight_, map, doing.goes_on, is_same), std::move(intent));
}

void task_control::begin_start(effects& out, std::optional<std::uint64_t> key, std::uint16_t sequence) {
  const task what{flight_.s.last_task + 1, task_kind::start, false, key, flight_.view.mode()->custom_mode};
  if (flight_.commands_home())
    out.emplace_back(note{home_commanded{true}});
  out.emplace_back(note{task_begun{what, {}}});
  flight_.runner.begin(what, start_steps(flight_, sequence), {});
}

steps task_control::guarded(steps way) {
  flight_.wanted.guard_again = false;
  if (!flight_.is_failsafe_gone)
    way.insert(way.begin(), guard{});
  return way;
}

// -- on the way -------------------------------------------------------------------------------------

bool task_control::run(effects& out, instant now) {
  const auto what = flight_.runner.doing();
  if (what && is_pointless(*what)) {
    flight_.runner.drop(flight_.world(now, out));
    end(out, "the plan before it has ended");
    return true;
  }
  switch (flight_.runner.advance(flight_.world(now, out))) {
  case task_runner::verdict::idle:
    return false;
  case task_runner::verdict::under_way:
    break;
  case task_runner::verdict::done:
    finish(out, *what, now);
    break;
  case task_runner::verdict::failed:
    fail(out, *what, flight_.runner.why_failed(), now);
    break;
  }
  return true;
}

// The plan ended before another one could take its place.
bool task_control::is_pointless(const task& what) const {
  return what.kind == task_kind::deploy && what.goes_on && flight_.is_plan_finished() && !deploys_after_end_ &&
         !flight_.s.progress.upload && flight_.s.progress.last_generation == deploying_over_;
}

void task_control::give_up(effects& out, instant now, const std::string& why) {
  flight_.runner.drop(flight_.world(now, out));
  gave_up_order_ = true;
  end(out, why);
}

void task_control::end(effects& out, const std::string& why) {
  const auto& doing = flight_.s.doing;
  if (!doing)
    return;
  if (doing->start_key)
    answer_start(out, *doing->start_key, start_verdict::failed, why);
  out.emplace_back(note{task_ended{doing->number}});
}

// -- the end ----------------------------------------------------------------------------------------

// A vehicle without plan ids does not tell when somebody else has brought it a plan between the proof and the order.
void task_control::verify_plan(instant now) {
  const auto& plan = flight_.s.progress.plan;
  if (plan && !plan->vehicle_plan_id)
    flight_.evidence.plan.doubt(now.now_ns);
}

void task_control::finish(effects& out, const task& what, instant now) {
  out.emplace_back(note{task_ended{what.number}});
  if (what.start_key)
    answer_start(out, *what.start_key,
                 what.kind == task_kind::await_arming ? start_verdict::awaits_arming : start_verdict::started, {});
  switch (what.kind) {
  case task_kind::deploy:
    finish_deploy(out, what);
    return;
  case task_kind::start:
    verify_plan(now);
    start_refused_since_ns_ = 0;
    flight_.refused_start.clear();
    flight_.was_up = flight_.view.is_under_way();
    out.emplace_back(note{preflight::took_off{}});
    phases_.go(out, trigger::started);
    return;
  case task_kind::hold:
    phases_.go(out, trigger::held, std::exchange(flight_.wanted.why_halt, {}));
    return;
  case task_kind::resume:
    verify_plan(now);
    phases_.go(out, trigger::resumed);
    return;
  case task_kind::come_home:
    return follow_return(out);
  case task_kind::come_home_by_plan:
    finish_way_home(out);
    return;
  case task_kind::free_home:
    out.emplace_back(note{home_commanded{false}});
    return;
  case task_kind::stand_down:
  case task_kind::stand_by:
  case task_kind::await_arming:
    return;
  }
}

void task_control::follow_return(effects& out) {
  out.emplace_back(note{progress::mission_aborted{}});
  phases_.go(out, trigger::called_home);
}

bool task_control::disarm_left_armed(effects& out) {
  const bool may = flight_.may_disarm();
  if (may)
    begin(out, task_kind::stand_down, {disarm{}});
  return may;
}

void task_control::follow_unheard(effects& out, instant now) {
  const auto what = flight_.runner.unheard();
  const auto& authority = flight_.authority;
  if (!what || flight_.runner.is_busy() || !flight_.is_in_flight() || flight_.has_person() || !authority.is_ours() ||
      authority.is_unclear())
    return;
  const bool is_return = *what == task_kind::come_home;
  if (!flight_.view.is_in(is_return ? mode_kind::returning : going_on_mode(flight_)))
    return;
  flight_.runner.forget_unheard();
  if (is_return)
    return follow_return(out);
  verify_plan(now);
  phases_.go(out, brings_plan(*what) ? trigger::plan_brought : trigger::resumed);
}

// It holds, or it flies it.
void task_control::finish_way_home(effects& out) {
  auto& at = flight_.homing.at;
  if (at == homing_stage::bringing)
    phases_.go(out, trigger::called_home, "the vehicle returns around the fences");
  at = at == homing_stage::holding ? homing_stage::held : homing_stage::none;
}

void task_control::finish_deploy(effects& out, const task& what) {
  const bool is_held = flight_.is_in_flight() && !what.goes_on;
  const bool is_brought_back = std::exchange(brings_back_, false) && is_held;
  phases_.go(out, is_held ? trigger::plan_brought_held : trigger::plan_brought,
             is_brought_back ? "held: the vehicle can not fly the plan that was brought to it, and has the mission's "
                               "again; resume goes on with that"
                             : "");
}

// Nothing of ours flies: the vehicle holds. What it had before is brought back, once.
void task_control::refuse_infeasible(effects& out, const std::string& why) {
  const auto& s = flight_.s;
  const auto revision = flight_.runner.brought_revision();
  if (s.arrived && s.arrived->revision == revision) {
    flight_.refused = refused_mission(flight_, s.arrived->mission_id, revision, why);
    flight_.refused_revision = {s.arrived->mission_id, revision};
    out.emplace_back(announce{"revision " + std::to_string(revision) + " of the mission is not flown: " + why, true});
    out.emplace_back(note{arrival_refused{revision}});
  }
  const bool was_brought_back = std::exchange(brings_back_, false);
  flight_.wanted.bring_back = flight_.is_in_flight() && s.mission && s.flown && !was_brought_back;
  const std::string what_next = flight_.wanted.bring_back ? "; it is held, and the plan before is brought back"
                                : flight_.is_in_flight()  ? "; it is held: goto, resume and come_home are possible"
                                                          : "; change the mission or the vehicle's limits, then resume";
  phases_.go(out, trigger::infeasible_plan_found, why + what_next);
}

bool task_control::is_start_tried_on(const task& what, instant now) {
  const bool is_automatic =
      what.kind == task_kind::start && !what.start_key && flight_.configured.start == start_policy::automatic;
  if (!is_automatic || !flight_.runner.was_refused_for_now() || flight_.runner.has_armed())
    return false; // after an ARM that may have been obeyed only a person starts again
  if (start_refused_since_ns_ == 0)
    start_refused_since_ns_ = now.now_ns;
  if (now.now_ns - start_refused_since_ns_ < start_patience_ns)
    return true;
  start_refused_since_ns_ = 0;
  return false;
}

void task_control::fail(effects& out, const task& what, const std::string& why, instant now) {
  const auto warn = [&](const std::string& sentence) { out.emplace_back(announce{sentence + why, true}); };
  out.emplace_back(note{task_ended{what.number}});
  if (what.start_key)
    answer_start(out, *what.start_key, start_verdict::failed, why);
  switch (what.kind) {
  case task_kind::stand_down:
    return warn("the vehicle was armed for the start, and may stand armed: ");
  case task_kind::stand_by:
    return warn(flight_.view.is_armed() ? "keep away from the vehicle: it stands armed in its mission mode. "
                                        : "do not arm the vehicle: it stands in its mission mode and would move. ");
  case task_kind::await_arming:
    flight_.awaited_arming.reset();
    return warn("the flight is not started: ");
  case task_kind::free_home:
    out.emplace_back(note{home_commanded{false}});
    return warn("the vehicle's home stays where the mission began, also when it is armed elsewhere: set it there. ");
  case task_kind::hold:
  case task_kind::come_home:
    warn("not executed: ");
    if (flight_.s.status.now != phase::paused)
      phases_.go(out, trigger::not_obeyed, "the vehicle did not execute the command: " + why);
    return;
  case task_kind::come_home_by_plan:
    flight_.homing.at = homing_stage::failed;
    flight_.homing.why = why;
    return;
  case task_kind::deploy:
    if (flight_.runner.was_infeasible())
      return refuse_infeasible(out, why);
    brings_back_ = false;
    if (flight_.is_in_flight() && flight_.view.is_in(mode_kind::mission)) // it has never left the plan before
      return warn("the vehicle goes on with the plan that it has: ");
    break;
  case task_kind::resume:
    break;
  case task_kind::start:
    flight_.refused_start = is_start_tried_on(what, now) ? why : std::string();
    if (!flight_.refused_start.empty())
      phases_.go(out, trigger::start_refused, flight_.refused_start_sentence());
    else
      phases_.go(out, trigger::start_failed, why);
    if (!flight_.view.is_in(mode_kind::mission))
      disarm_left_armed(out);
    return;
  }
  phases_.go(out, trigger::task_failed, why);
}

} // namespace godwit::executor
