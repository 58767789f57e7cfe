// What is begun, and what becomes of it.
#include <algorithm>
#include <utility>

#include "actors/domain/uuid/uuid.hpp"
#include "actors/executor/core.hpp"
#include "actors/executor/plan/fence_check.hpp"
#include "actors/executor/preflight/report.hpp"
#include "actors/executor/remaining.hpp"
#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;
using io::mavlink::mav_autopilot;

constexpr std::int64_t check_period_ns = 1'000'000'000;

bool holds_our_plan(pause_cause cause) {
  return cause != pause_cause::foreign_plan && cause != pause_cause::vehicle_restarted;
}

} // namespace

// -- the standing -----------------------------------------------------------------------------------

void core::stand(effects& out, phase now, pause_cause cause, const std::string& reason) {
  stand(out, stood{now, cause, reason, is_in_flight()});
}

void core::stand(effects& out, const stood& next) {
  if (next != s_.standing)
    out.emplace_back(note{next});
}

void core::stand_as(effects& out, phase now, bool in_flight) {
  stand(out, stood{now, pause_cause::none, {}, in_flight});
}

void core::stand_paused(effects& out, pause_cause cause, const std::string& reason) {
  stand(out, phase::paused, cause, reason);
}

void core::answer_start(effects& out, std::uint64_t key, start_verdict verdict, const std::string& reason) {
  out.emplace_back(note{start_settled{{key, verdict, reason}}});
}

// -- tasks ------------------------------------------------------------------------------------------

void core::begin(effects& out, task_kind kind, steps way, bool goes_on) {
  const task what{s_.last_task + 1, kind, goes_on, {}};
  out.emplace_back(note{task_begun{what, {}}});
  runner_.begin(what, std::move(way), {});
  if (std::exchange(gave_up_order_, false))
    runner_.ask_all_the_same();
}

void core::begin_deploy(effects& out, const mission::document& mission, const plan::flight_plan& what,
                        const std::optional<std::string>& assignment, bool goes_on) {
  const task doing{s_.last_task + 1, task_kind::deploy, goes_on, {}};
  progress::upload_intended intent{mission.revision, what.map, {}, {}};
  if (view_.keeps_plan_ids() && view_.current())
    intent.id_before = view_.current()->mission_id;
  if (assignment)
    intent.assignment = progress::assignment_key{*assignment, ids::derived_uuid(*assignment, mission.mission_id)};
  out.emplace_back(note{task_begun{doing, deployment{mission, what.items, what.landing_sequence, what.surveys}}});
  must_choose_item_ = false;
  deploying_over_ = s_.progress.last_generation;
  deploys_behind_end_ = is_plan_finished();
  runner_.begin(doing, deploy_steps(what.map, goes_on), std::move(intent));
}

void core::begin_start(effects& out, std::optional<std::uint64_t> key) {
  const task what{s_.last_task + 1, task_kind::start, false, key};
  stand(out, phase::starting);
  authority_.begin(*view_.mode());
  was_armed_ = view_.is_armed();
  if (stance_ && stance_->taken_over) { // of a flight before; whoever starts this one hands the vehicle over
    stance_->taken_over = false;
    out.emplace_back(say_to_failsafe{failsafe::hand_back{}});
  }
  out.emplace_back(note{task_begun{what, {}}});
  runner_.begin(what, start_steps(), {});
}

// A vehicle that keeps ids activates the new plan itself, at the item that is marked in it. Others are held while
// their plan is replaced, and told where to go on.
steps core::deploy_steps(const progress::plan_map& map, bool goes_on) const {
  if (!is_in_flight()) {
    steps result = out_of_mission_steps();
    result.emplace_back(bring_plan{});
    return result;
  }
  const auto autopilot = view_.owner().autopilot;
  if (autopilot == mav_autopilot::px4)
    return goes_on ? steps{bring_plan{}, guard{}, change_mode{mode_kind::mission}} : steps{bring_plan{}, guard{}};
  steps result{change_mode{mode_kind::hold}, bring_plan{}, guard{}};
  if (autopilot == mav_autopilot::ardupilotmega) {
    result.emplace_back(choose_item{map.start_sequence});
    if (goes_on)
      result.emplace_back(change_mode{mode_kind::mission});
  } else if (goes_on) {
    result.emplace_back(start_plan{map.start_sequence});
  }
  return result;
}

bool core::is_copter() const {
  return view_.owner().autopilot == mav_autopilot::ardupilotmega &&
         view_.owner().vehicle == flight::vehicle_class::multirotor;
}

// A vehicle that is left in its mission mode on the ground would begin what it holds as soon as somebody arms it (PX4),
// or does not begin at all when it is started in the mode in which it is (ArduPilot's rover).
steps core::out_of_mission_steps() const {
  const bool stands_behind_it = view_.says_complete() && !is_in_air();
  if (!view_.is_in(mode_kind::mission) || (view_.is_armed() && !stands_behind_it))
    return {};
  return {stand_by{view_.is_armed()}};
}

// ArduPilot's Copter can not be armed in AUTO.
steps core::start_steps() const {
  steps result{guard{}};
  if (!view_.is_armed()) {
    for (auto& each : out_of_mission_steps())
      result.push_back(std::move(each));
    if (is_copter())
      result.emplace_back(change_mode{mode_kind::guided});
    result.emplace_back(arm{});
  }
  result.emplace_back(start_plan{s_.progress.plan->map.start_sequence});
  return result;
}

void core::task_done(effects& out, const task& what) {
  out.emplace_back(note{task_ended{what.number}});
  switch (what.kind) {
  case task_kind::deploy:
    if (is_in_flight())
      what.goes_on ? stand_as(out, phase::flying, true)
                   : stand(out, phase::paused, pause_cause::asked, "held as asked");
    else
      stand(out, phase::ready);
    return;
  case task_kind::start:
    if (what.start_key)
      answer_start(out, *what.start_key, start_verdict::started, {});
    start_refused_since_ns_ = 0;
    was_up_ = view_.is_under_way();
    out.emplace_back(note{preflight::took_off{}});
    stand_as(out, phase::flying, true);
    return;
  case task_kind::hold:
    stand_paused(out, pause_cause::asked, "held as asked");
    return;
  case task_kind::resume:
    stand_as(out, is_plan_finished() ? phase::landing : phase::flying, true);
    return;
  case task_kind::stand_down:
  case task_kind::stand_by:
    return;
  case task_kind::come_home:
    out.emplace_back(note{progress::mission_aborted{}});
    stand(out, phase::landing, pause_cause::none, "the vehicle returns");
    return;
  }
}

bool core::is_start_tried_on(const task& what, instant now) {
  const bool is_automatic =
      what.kind == task_kind::start && !what.start_key && settings_.start == start_policy::automatic;
  if (!is_automatic || !runner_.was_refused_for_now())
    return false;
  if (start_refused_since_ns_ == 0)
    start_refused_since_ns_ = now.now_ns;
  if (now.now_ns - start_refused_since_ns_ < start_patience_ns)
    return true;
  start_refused_since_ns_ = 0;
  return false;
}

void core::task_failed(effects& out, const task& what, const std::string& why, instant now) {
  out.emplace_back(note{task_ended{what.number}});
  if (what.start_key)
    answer_start(out, *what.start_key, start_verdict::failed, why);
  if (what.kind == task_kind::stand_down) {
    out.emplace_back(announce{"the vehicle stays armed: " + why, true});
    return;
  }
  if (what.kind == task_kind::stand_by) {
    out.emplace_back(announce{"do not arm the vehicle: it stands in its mission mode and would move. " + why, true});
    return;
  }
  if (what.kind == task_kind::hold || what.kind == task_kind::come_home) {
    out.emplace_back(announce{"not obeyed: " + why, true});
    stand(out, s_.standing.now, s_.standing.cause,
          s_.standing.now == phase::paused ? s_.standing.reason : "the vehicle has not obeyed: " + why);
    return;
  }
  const bool is_rejected_replan = what.kind == task_kind::deploy && is_in_flight() && view_.is_in(mode_kind::mission);
  if (is_rejected_replan) // it has never left the plan before
    out.emplace_back(announce{"the vehicle goes on with the plan that it has: " + why, true});
  else if (is_start_tried_on(what, now))
    stand(out, phase::ready, pause_cause::none, why + "; it is tried again");
  else
    stand(out, {phase::paused, pause_cause::not_done, why,
                is_in_flight() || (what.kind == task_kind::start && is_in_air())});
  const bool is_left_armed = what.kind == task_kind::start && runner_.has_armed() && view_.is_armed() && !is_in_air();
  if (is_left_armed && !view_.is_in(mode_kind::mission))
    begin(out, task_kind::stand_down, {disarm{}});
}

// Of a rover, that it is armed says nothing.
bool core::is_in_air() const { return view_.owner().vehicle != flight::vehicle_class::rover && view_.is_under_way(); }

// -- planning ---------------------------------------------------------------------------------------

bool core::plan_has_home() const { return view_.owner().autopilot == mav_autopilot::ardupilotmega; }

std::optional<plan::plan_setting> core::setting(instant now) const {
  const auto place = view_.place(now.now_ns);
  if (!place || !view_.home() || view_.owner().vehicle == flight::vehicle_class::unknown)
    return std::nullopt;
  plan::plan_setting result;
  result.vehicle = view_.owner().vehicle;
  result.autopilot = view_.owner().autopilot;
  result.home = *view_.home();
  result.start = *place;
  result.is_under_way = view_.is_under_way();
  result.own_loiter_radius_m = settings_.own_loiter_radius_m;
  result.return_altitude_m = settings_.return_altitude_m;
  result.marks_landings = settings_.marks_landings;
  return result;
}

preflight::report core::look_at_all(instant now) {
  preflight::facts seen;
  auto& vehicle = seen.vehicle;
  vehicle.link = view_.link();
  vehicle.what = view_.owner().vehicle;
  vehicle.autopilot = view_.owner().autopilot;
  vehicle.fix = static_cast<io::mavlink::gps_fix_type>(view_.fix_type());
  if (view_.satellites() >= 0)
    vehicle.satellites = static_cast<std::uint8_t>(view_.satellites());
  if (view_.place_heard_ns() != 0)
    vehicle.position_age_ns = now.now_ns - view_.place_heard_ns();
  vehicle.is_home_known = view_.home().has_value();
  vehicle.battery_percent = view_.battery_percent(); // absent before the first word of it
  vehicle.own = view_.own_checks();
  vehicle.is_moving = view_.is_moving() && !is_in_flight();
  seen.mission.document = s_.mission ? &*s_.mission : nullptr;
  seen.mission.refusal = refusal_;
  seen.mission.has_service = settings_.has_service;
  seen.mission.map = map_;
  seen.mission.map_problem = map_problem_;
  if (const auto where = setting(now); where && s_.mission) {
    plans_ = plan::build_plans(*s_.mission, *where, going_on(*s_.mission, first_item(*s_.mission)));
    seen.mission.plans = &*plans_;
    seen.mission.return_point = plan::return_point_violations(*s_.mission);
    if (*plans_) {
      seen.mission.way.emplace();
      for (const auto& each : **plans_)
        for (auto& found : plan::fence_violations(each, *s_.mission, where->vehicle))
          seen.mission.way->push_back(std::move(found));
    }
  }
  seen.journal = house_.journal;
  seen.actors = house_.actors;
  seen.wall_ns = now.wall_ns;
  seen.is_operator_session_alive = house_.is_operator_session_alive;
  seen.camera = preflight::camera_state::off;
  return preflight::run_checks(seen, settings_.checks);
}

// -- what is begun ----------------------------------------------------------------------------------

// One at a time, and only while a plan may be changed.
bool core::answer_assignment(effects& out, instant now) {
  const auto at = s_.standing.now;
  const bool is_waiting_on_ground = !is_in_flight() && (at == phase::connected || at == phase::preflight ||
                                                        at == phase::ready || at == phase::disconnected);
  if (s_.waiting.empty() || !s_.mission)
    return false;
  if (has_open_intent())
    return false; // of a task that was given up: its end is on the way
  const bool is_too_late = (is_mission_finished() && !may_change_plan()) || at == phase::aborted;
  if (!is_too_late && !(may_change_plan() || is_waiting_on_ground))
    return false;
  if (!is_too_late && may_change_plan() && !view_.is_under_way())
    return false; // on the ground with turning motors: a plan that is replaced now would never take off
  const auto wish = s_.waiting.front();
  const auto reject = [&](const std::string& why) {
    out.emplace_back(note{assignment_rejected{wish.assignment_id, why}});
    return true;
  };
  if (is_too_late)
    return reject("the mission was over before the assignment came");
  auto wanted = reassign(*s_.mission, wish, last_done(s_));
  if (!wanted)
    return reject(wanted.error());
  if (is_waiting_on_ground) {
    if (s_.assigned)
      return false; // its answer goes out with the upload
    out.emplace_back(note{mission_taken{std::move(wanted->mission), wish.assignment_id}});
    out.emplace_back(note{preflight::mission_changed{s_.mission->mission_id, wish.revision}});
    if (at != phase::disconnected)
      stand(out, phase::connected); // and from there through the checks again
    return true;
  }
  const auto where = setting(now);
  if (!where)
    return true; // until the vehicle is heard
  auto plans = plan::build_plans(wanted->mission, *where, going_on(wanted->mission, wanted->first_item));
  if (!plans)
    return reject(plans.error().message());
  if (const auto found = plan::fence_violations(plans->front(), wanted->mission, where->vehicle); !found.empty())
    return reject(found.front().message);
  begin_deploy(out, wanted->mission, plans->front(), wish.assignment_id, at != phase::paused);
  return true;
}

bool core::begin_wished(effects& out, instant now) {
  if (is_handed_back_) {
    is_handed_back_ = false;
    if (!has_person())
      return false;
    out.emplace_back(say_to_failsafe{failsafe::hand_back{}});
    if (stance_) { // what still holds then is told anew
      stance_->taken_over = false;
      stance_->reacts.reset();
    }
    if (is_in_flight() && view_.mode())
      authority_.begin(*view_.mode());
    if (is_over(s_.standing.now))
      stand(out, s_.standing.now);
    else if (is_in_flight() && view_.is_in(mode_kind::mission))
      stand_as(out, is_plan_finished() ? phase::landing : phase::flying, true);
    else
      stand_paused(out, pause_cause::asked, "handed back; resume goes on with the mission");
    return true;
  }
  if (has_person()) {
    if (asked_start_)
      answer_start(out, std::exchange(asked_start_, {})->key, start_verdict::not_ready, s_.standing.reason);
    return true;
  }
  if (finishes_intent_) {
    finishes_intent_ = false;
    begin_going_on(out);
    return true;
  }
  if (must_guard_ && s_.standing.now != phase::paused && s_.flown) {
    must_guard_ = false;
    begin(out, task_kind::resume, {guard{}});
    return true;
  }
  if (must_choose_item_ && s_.standing.now == phase::flying && s_.progress.plan) {
    must_choose_item_ = false;
    begin_at_start(out);
    return true;
  }
  if (wanted_change_)
    return begin_change(out, now);
  if (wanted_ && !has_open_intent()) // a resume, behind the end of what was given up
    return begin_wanted(out, *std::exchange(wanted_, {}), now);
  if (asked_start_)
    return begin_asked_start(out, *std::exchange(asked_start_, {}), now);
  if (is_start_wanted_) {
    is_start_wanted_ = false;
    if (const auto why = why_not_start(out, now); !why.empty())
      out.emplace_back(announce{"the flight is not started: " + why, true});
    else
      begin_start(out, {});
    return true;
  }
  return false;
}

// One by the MAVLink text alone stays in its mission mode when it holds, and goes on only when it is started.
bool core::starts_in_mission_mode() const {
  const auto autopilot = view_.owner().autopilot;
  return autopilot != mav_autopilot::px4 && autopilot != mav_autopilot::ardupilotmega;
}

// The vehicle has another item than the one with which it should begin. A new incarnation starts nothing.
void core::begin_at_start(effects& out) {
  const auto start = s_.progress.plan->generation.start_sequence;
  const bool has_begun_task = s_.last_task != last_task_before_;
  const bool may_start = starts_in_mission_mode() && has_begun_task;
  begin(out, task_kind::resume,
        may_start ? steps{start_plan{start}} : steps{choose_item{start}, change_mode{mode_kind::mission}});
}

// Back into the plan that the vehicle holds, or into one that was brought to it in flight.
steps core::going_on_steps() const {
  const bool is_new = s_.progress.plan && !s_.progress.plan->generation.was_active &&
                      s_.progress.plan->generation.origin != progress::generation_origin::start;
  if (is_new && starts_in_mission_mode())
    return {start_plan{s_.progress.plan->generation.start_sequence}};
  if (is_new && view_.owner().autopilot == mav_autopilot::ardupilotmega) // it goes on where it was in the plan before
    return {choose_item{s_.progress.plan->generation.start_sequence}, change_mode{mode_kind::mission}};
  return {change_mode{mode_kind::mission}};
}

// The vehicle is held with the new plan; whether it was told where to begin is not known.
void core::begin_going_on(effects& out) {
  auto way = going_on_steps();
  if (std::holds_alternative<start_plan>(way.front())) { // a start, which nothing but a person's word may cause
    stand_paused(out, pause_cause::asked, "godwit was restarted while it replaced the plan; resume starts the new one");
    return;
  }
  const bool chooses = std::holds_alternative<choose_item>(way.front());
  if (view_.owner().autopilot == mav_autopilot::ardupilotmega && s_.progress.plan && !chooses)
    way.insert(way.begin(), choose_item{s_.progress.plan->generation.start_sequence});
  begin(out, task_kind::resume, guarded(std::move(way)));
}

// The failsafe takes the same limits twice without harm.
steps core::guarded(steps way) {
  must_guard_ = false;
  way.insert(way.begin(), guard{});
  return way;
}

// The vehicle holds another plan, or none: a person wants the rest of the mission flown all the same.
void core::begin_again(effects& out, instant now) {
  const auto plan = plan_in_flight(*s_.mission, now);
  if (plan)
    begin_deploy(out, *s_.mission, *plan, {}, true);
  else
    out.emplace_back(announce{"the rest of the mission can not be flown from here: " + plan.error(), true});
}

bool core::begin_wanted(effects& out, task_kind what, instant now) {
  if (!is_in_flight() && what == task_kind::resume) {
    if (s_.standing.now != phase::paused)
      return false;
    stand(out, phase::connected);
    return true;
  }
  if (s_.change && !s_.arrived) // an operator who says something else waits for the service no longer
    out.emplace_back(note{change_settled{s_.change->key, false}});
  if (what == task_kind::hold) {
    if (s_.standing.now == phase::flying || s_.standing.now == phase::landing)
      stand(out, s_.standing.now, pause_cause::none, "pausing: the vehicle was told to hold");
    begin(out, what, {change_mode{mode_kind::hold}});
  } else if (what == task_kind::resume && !holds_our_plan(s_.standing.cause))
    begin_again(out, now);
  else if (what == task_kind::resume)
    begin(out, what, guarded(going_on_steps()));
  else
    begin(out, what, {change_mode{mode_kind::returning}});
  return true;
}

// The sentence says why not; empty: it may.
std::string core::why_not_start(effects& out, instant now) {
  if (s_.standing.now != phase::ready || !s_.progress.plan || !s_.mission)
    return sentence();
  const preflight::looked look{look_at_all(now)};
  auto why = preflight::why_not_start(s_.preflight, look.what, now.wall_ns);
  if (preflight::matters(s_.preflight, look, now.wall_ns))
    out.emplace_back(note{look});
  if (!why.empty())
    return why;
  if (!view_.is_armed() && !settings_.arm_on_start)
    return "the vehicle is disarmed, and starting does not arm it (arm_on_start)";
  return {};
}

bool core::begin_asked_start(effects& out, const start_mission& asked, instant now) {
  const bool is_disarmed = !view_.is_armed() && !settings_.arm_on_start;
  if (now.wall_ns > asked.obey_until_ns)
    answer_start(out, asked.key, start_verdict::too_late, "the request came too late");
  else if (const auto why = why_not_start(out, now); !why.empty())
    answer_start(out, asked.key, is_disarmed ? start_verdict::disarmed : start_verdict::not_ready, why);
  else
    begin_start(out, asked.key);
  return true;
}

// Our plan is flown, and nobody here has started it: a start whose sender died came through, or somebody else has said
// it. It is followed, and guarded; nothing else is sent.
bool core::follow_started(effects& out) {
  const auto at = s_.standing.now;
  const bool waits = at == phase::ready || (at == phase::paused && s_.standing.cause == pause_cause::restarted);
  const bool flies = view_.is_under_way() && view_.is_in_begun_mission();
  if (is_in_flight() || !waits || !flies || !s_.progress.plan || !s_.flown)
    return false;
  authority_.begin(*view_.mode());
  was_up_ = true;
  out.emplace_back(note{preflight::took_off{}});
  stand_as(out, phase::flying, true);
  begin(out, task_kind::resume, {guard{}, change_mode{mode_kind::mission}});
  return true;
}

bool core::has_nothing_left(const mission::document& next) const {
  return is_same_mission(next) && first_item(next) >= next.items.size();
}

bool core::is_same_mission(const mission::document& next) const {
  return s_.mission && s_.mission->mission_id == next.mission_id;
}

// On the ground: from the link to a plan that is ready.
bool core::prepare(effects& out, instant now) {
  const auto at = s_.standing.now;
  const bool is_prepared =
      at == phase::disconnected || at == phase::connected || at == phase::preflight || at == phase::ready;
  const bool is_over = is_at_rest(at);
  if (is_in_flight() || has_person() || !(is_prepared || (is_over && s_.arrived)))
    return false;
  if (!view_.is_connected() || !view_.mode()) {
    stand(out, phase::disconnected, pause_cause::none, view_.why_not_connected());
    return true;
  }
  if (s_.arrived && (has_nothing_left(*s_.arrived) || (is_over && is_same_mission(*s_.arrived)))) {
    out.emplace_back(
        announce{"revision " + std::to_string(s_.arrived->revision) + " came when the mission was over", true});
    out.emplace_back(note{arrival_refused{s_.arrived->revision}});
    return true;
  }
  if (s_.arrived) {
    const auto next = *s_.arrived;
    out.emplace_back(note{mission_taken{next, {}}});
    out.emplace_back(note{preflight::mission_changed{next.mission_id, next.revision}});
    stand(out, phase::connected);
    return true;
  }
  if (at == phase::disconnected) {
    stand(out, phase::connected);
    return true;
  }
  if (!s_.mission) { // a station has cleared it, or there never was one
    stand(out, phase::connected);
    return false;
  }
  if (acknowledged_) {
    out.emplace_back(note{*std::exchange(acknowledged_, {})});
    return true;
  }
  if (at == phase::connected || std::exchange(wants_checks_, false)) {
    out.emplace_back(note{preflight::checks_wanted{s_.mission->mission_id, s_.mission->revision}});
    stand(out, phase::preflight);
    checked_ns_ = 0;
    return true;
  }
  if (checked_ns_ != 0 && now.now_ns - checked_ns_ < check_period_ns)
    return false;
  checked_ns_ = now.now_ns;
  const preflight::looked look{look_at_all(now)};
  if (preflight::matters(s_.preflight, look, now.wall_ns)) {
    out.emplace_back(note{look});
    checked_ns_ = 0; // and what comes of it at once
    return true;
  }
  if (!preflight::why_not_start(s_.preflight, look.what, now.wall_ns).empty())
    return false;
  if (at == phase::preflight && plans_ && *plans_) {
    const auto& first = (*plans_)->front();
    stand(out, phase::uploading);
    begin_deploy(out, *s_.mission, first, s_.assigned, false);
    return true;
  }
  const bool waits_for_word = s_.awaits_word && settings_.takeoff_again == start_policy::on_command;
  const bool starts_itself = settings_.start == start_policy::automatic && settings_.arm_on_start && !waits_for_word;
  const bool is_rover = view_.owner().vehicle == flight::vehicle_class::rover;
  const bool stands = !view_.is_under_way() || (is_rover && view_.is_in(mode_kind::hold)); // and nobody drives it
  if (at == phase::ready && waits_for_word && settings_.start == start_policy::automatic)
    stand(out, phase::ready, pause_cause::none, "this mission was begun before; a person has to start it");
  if (at == phase::ready && starts_itself && stands) {
    begin_start(out, {});
    return true;
  }
  return false;
}

} // namespace godwit::executor
