#include "actors/executor/flight/plan_changes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "actors/executor/flight/mission_list.hpp"
#include "actors/executor/plan/fence_check.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/remaining.hpp"

namespace godwit::executor {
namespace {

using flight::mode_kind;
using operators::command_kind;

constexpr std::uint64_t changes = 0x6368616e6765; // keeps their keys apart from whatever else follows from a mission

constexpr std::int64_t stands_within_ns = 5'000'000'000; // what was told to hold, at any speed

// At the place to which an operator has sent the vehicle; then the mission is over.
constexpr double stay_s = 3'600;

constexpr double lowest_m = 1; // what flies is sent above home

operators::answer refused(std::string why) { return {false, std::move(why)}; }

std::string_view reason_for(change_kind kind) {
  switch (kind) {
  case change_kind::go_to:
    return "an operator sent the vehicle elsewhere";
  case change_kind::cancel:
    return "an operator sent the vehicle back to its mission";
  case change_kind::insert:
    break;
  }
  return "an operator inserted a waypoint";
}

// Of a monotonic time.
std::int64_t wall_ns_of(std::int64_t at_ns, instant now) { return now.wall_ns - (now.now_ns - at_ns); }

} // namespace

// -- a command -----------------------------------------------------------------------------------------

operators::answer plan_changes::take(const operators::command& m, instant now) {
  if (!flight_.may_change_plan() || !flight_.s.mission)
    return refused("the mission can not be changed now: " + flight_.sentence());
  const auto& s = flight_.s;
  const auto& doing = flight_.runner.doing();
  const bool is_pausing = doing && doing->kind == task_kind::hold; // then it goes there after that
  if (s.change || flight_.wanted.change || (flight_.runner.is_busy() && !is_pausing) || !s.waiting.empty() || s.arrived)
    return refused("another change is under way; repeat the command when it is finished");
  if (m.kind != command_kind::cancel && !m.place)
    return refused("the command has no place");
  if (m.kind != command_kind::cancel)
    if (auto why = why_not_there(*m.place, now); !why.empty())
      return refused(std::move(why));
  auto what = change_of(m, now);
  if (!what)
    return refused(std::move(what.error()));
  if (auto why = why_not_changed(*what, now); !why.empty())
    return refused(std::move(why));
  if (s.flown_changes.size() >= max_flown_changes)
    return refused("the missions service has not answered " + std::to_string(max_flown_changes) +
                   " changes yet; repeat the command when it is back");
  if (flight_.is_journal_nearly_full && m.kind != command_kind::cancel)
    return refused(
        "the plan is not changed while so much waits for the journal's disk; repeat the command when it is written");
  what->said_ns = now.now_ns;
  what->after = m.after;
  flight_.wanted.put_change(*std::move(what));
  return {true, {}};
}

plan_changes::change_or_reason plan_changes::change_of(const operators::command& m, instant now) const {
  if (m.kind == command_kind::go_to)
    return go_there(*m.place, now);
  return m.kind == command_kind::cancel ? cancel(now) : insert(m);
}

// Empty: a place like those of a mission, within the limits that are set.
std::string plan_changes::why_not_there(const mission::position& to, instant now) const {
  const auto there = plan::point_of(to);
  if (!geo::is_valid(there) || !std::isfinite(to.altitude_m))
    return "the place is none: latitude -90 to 90, longitude -180 to 180, altitude in metres above home";
  const auto highest_m = flight_.configured.limits.max_altitude_m;
  if (to.altitude_m > highest_m || (!flight_.drives() && to.altitude_m < lowest_m))
    return "the altitude has to be between " + std::to_string(static_cast<int>(lowest_m)) + " and " +
           std::to_string(static_cast<int>(highest_m)) + " m above home (flight.max_altitude_m)";
  const auto found = flight_.out_of_limits("the place", to, now);
  return found.value_or("the vehicle has reported no home yet");
}

// NAME is that of the change; the turns are flown at the altitude of where they lead.
std::vector<mission::item> plan_changes::items_of(const std::vector<geo::point>& turns, double altitude_m,
                                                  const std::string& name) const {
  std::vector<mission::item> result;
  for (const auto& each : turns)
    result.emplace_back(
        turn_at(each, altitude_m, name + "-" + std::to_string(result.size() + 1), flight_.view.owner().vehicle));
  return result;
}

plan_changes::change_or_reason plan_changes::go_there(const mission::position& to, instant now) const {
  const auto from = flight_.view.place(now.now_ns);
  if (!from)
    return tl::make_unexpected(std::string("the vehicle reports no position"));
  const auto turns = turns_between(flight_.way_between(*from, to), flight_.s.mission->geofences);
  if (!turns)
    return tl::make_unexpected("there is no way there: " + turns.error());
  plan_change result;
  result.to = to;
  result.leads_around = true;
  result.after_item_id = last_done(flight_.s);
  const auto name = std::string(go_to_id) + std::to_string(flight_.s.last_task + 1);
  result.items = items_of(*turns, to.altitude_m, name);
  result.items.emplace_back(mission::loiter{name, to, 0, stay_s});
  if (flight_.s.set_aside.empty()) {
    const auto& items = flight_.s.mission->items;
    const auto first = first_remaining(*flight_.s.mission, result.after_item_id);
    result.set_aside.assign(items.begin() + static_cast<std::ptrdiff_t>(first), items.end());
  }
  return result;
}

// The first place to which the plan leads that the change would make.
std::optional<mission::position> plan_changes::first_place(const plan_change& what, instant now) const {
  const auto after = changed(what);
  const auto where = flight_.setting(now);
  if (!after || !where)
    return std::nullopt;
  const auto plans = plan::build_plans(*after, *where, flight_.going_on(*after, flight_.first_item(*after)));
  if (!plans)
    return std::nullopt;
  const auto& legs = plans->front().legs;
  const auto moves = std::ranges::find_if(legs, [](const plan::leg& each) {
    return each.from.latitude != each.to.latitude || each.from.longitude != each.to.longitude;
  });
  return moves == legs.end() ? std::nullopt : std::optional(moves->to);
}

// A mission may lead nearer to a fence than the margin: then it goes there straight, where that crosses none.
plan_changes::change_or_reason plan_changes::cancel(instant now) const {
  if (flight_.s.set_aside.empty())
    return tl::make_unexpected(std::string("there is nothing to cancel: the vehicle was not sent elsewhere"));
  plan_change result;
  result.kind = change_kind::cancel;
  result.after_item_id = last_done(flight_.s);
  result.items = flight_.s.set_aside;
  const auto from = flight_.view.place(now.now_ns);
  const auto to = first_place(result, now);
  if (!from || !to || flight_.s.mission->geofences.empty())
    return result;
  const auto turns = turns_between(flight_.way_between(*from, *to), flight_.s.mission->geofences);
  if (!turns && !why_not_changed(result, now).empty())
    return tl::make_unexpected("there is no way back to the mission: " + turns.error());
  if (!turns)
    return result;
  const auto items =
      items_of(*turns, to->altitude_m, std::string(way_back_id) + std::to_string(flight_.s.last_task + 1));
  result.leads_around = !items.empty();
  result.items.insert(result.items.begin(), items.begin(), items.end());
  return result;
}

plan_changes::change_or_reason plan_changes::insert(const operators::command& m) const {
  auto after = last_done(flight_.s);
  if (!m.after.empty()) {
    const auto index = mission::index_of(flight_.s.mission->items, m.after);
    if (!index)
      return tl::make_unexpected("the mission has no item '" + m.after + "'");
    if (*index + 1 < first_remaining(*flight_.s.mission, after))
      return tl::make_unexpected("what comes after item '" + m.after + "' is flown already");
    after = m.after;
  }
  mission::waypoint extra;
  extra.id = "extra" + std::to_string(flight_.s.last_task + 1);
  extra.at = *m.place;
  plan_change result;
  result.kind = change_kind::insert;
  result.to = m.place;
  result.after_item_id = std::move(after);
  result.items.emplace_back(std::move(extra));
  return result;
}

// As the service will make it, so that nothing is asked of it that can not be flown.
tl::expected<mission::document, std::string> plan_changes::changed(const plan_change& what) const {
  const auto& mission = *flight_.s.mission;
  mission::assignment local;
  local.base_revision = mission.revision;
  local.revision = mission.revision + 1;
  local.replace_after_item_id = what.after_item_id;
  local.items = what.items;
  if (what.kind == change_kind::insert) {
    const auto next = first_remaining(mission, what.after_item_id);
    local.items.insert(local.items.end(), mission.items.begin() + static_cast<std::ptrdiff_t>(next),
                       mission.items.end());
  }
  return reassign(mission, local, last_done(flight_.s)).map([](reassigned&& all) { return std::move(all.mission); });
}

// Empty: it can be flown.
std::string plan_changes::why_not_changed(const plan_change& what, instant now) const {
  const auto after = changed(what);
  if (!after)
    return after.error();
  const auto plan = flight_.plan_in_flight(*after, now);
  return plan ? std::string() : plan.error();
}

void plan_changes::keep_commanded(effects& out, bool has_looked, instant now) {
  const auto& wanted = flight_.wanted;
  const auto& kept = flight_.s.commanded;
  if (wanted.change || wanted.halt || wanted.go_on || flight_.has_person())
    may_take_up_ = false;
  if (wanted.change && !kept)
    out.emplace_back(note{change_commanded{commanded_change{
        wanted.change->kind, wanted.change->to, wanted.change->after, wall_ns_of(wanted.change->said_ns, now)}}});
  else if (!wanted.change && kept && may_take_up_ && has_looked && flight_.may_plan(now))
    take_up_commanded(out, now);
  else if (!wanted.change && kept && !may_take_up_)
    out.emplace_back(note{change_commanded{}});
}

// By an incarnation that finds it in the journal: as if it were commanded now, but for its time.
void plan_changes::take_up_commanded(effects& out, instant now) {
  const auto kept = *flight_.s.commanded;
  operators::command command;
  command.kind = kept.kind == change_kind::go_to    ? command_kind::go_to
                 : kept.kind == change_kind::cancel ? command_kind::cancel
                                                    : command_kind::insert;
  command.place = kept.to;
  command.after = kept.after;
  may_take_up_ = false;
  const auto answer =
      is_too_old(kept.said_ns, now) ? refused("it was commanded too long ago; repeat it") : take(command, now);
  if (!answer.is_taken)
    return drop(out, answer.reason);
  flight_.wanted.change->said_ns = now.now_ns - std::max<std::int64_t>(now.wall_ns - kept.said_ns, 0);
}

bool plan_changes::begin_wanted(effects& out, instant now) {
  auto& wanted = flight_.wanted.change;
  if (!wanted)
    return false;
  if (!flight_.is_in_flight() || (flight_.is_plan_finished() && !flight_.hovers()))
    drop(out, "the flight was over before");
  else if (!wanted->leads_around || stands_for_change(out, now))
    begin_from_here(out, now);
  return true;
}

// Who is sent elsewhere holds first: the mission that goes on meanwhile would fly away from there, and it stands before
// its plan changes. Where a service is asked it does so while that answers, but for a way around fences, which begins
// there. A fixed wing circles.
bool plan_changes::stands_for_change(effects& out, instant now) {
  auto& wanted = *flight_.wanted.change;
  if (!flight_.view.obeys(mode_kind::hold)) {
    if (!std::exchange(wanted.is_held_for, true))
      tasks_.begin(out, task_kind::hold, {change_mode{mode_kind::hold}});
    else
      drop(out, "the vehicle does not hold");
    return false;
  }
  if (wanted.held_since_ns == 0)
    wanted.held_since_ns = now.now_ns;
  const bool circles = flight_.view.owner().vehicle == flight::vehicle_class::fixed_wing;
  const bool goes_straight = flight_.has_service() && flight_.s.mission->geofences.empty();
  return circles || goes_straight || flight_.view.stands() || now.now_ns - wanted.held_since_ns >= stands_within_ns;
}

// The way that was found when it was said began where the vehicle was then.
void plan_changes::begin_from_here(effects& out, instant now) {
  auto& wanted = *flight_.wanted.change;
  auto here = wanted.kind == change_kind::go_to    ? go_there(*wanted.to, now)
              : wanted.kind == change_kind::cancel ? cancel(now)
                                                   : change_or_reason(wanted);
  if (!here)
    return drop(out, here.error());
  here->said_ns = wanted.said_ns;
  here->after = wanted.after;
  if (here->leads_around && !wanted.leads_around) { // it has flown behind a fence since
    wanted = *std::move(here);
    static_cast<void>(begin_wanted(out, now));
    return;
  }
  flight_.wanted.change.reset();
  ask_for(out, *here, now);
}

void plan_changes::ask_for(effects& out, const plan_change& what, instant now) {
  auto revised = changed(what); // it may have come further meanwhile
  if (!revised)
    return drop(out, revised.error());
  const auto& mission = *flight_.s.mission;
  const auto number = ids::text_of({changes, static_cast<std::uint64_t>(now.wall_ns)});
  change_asked asked;
  const auto& refused = flight_.refused_revision;
  const bool has_refused = flight_.has_service() && refused && refused->first == mission.mission_id;
  const auto revision = has_refused ? std::max(mission.revision, refused->second) : mission.revision;
  asked.what = {ids::derived_uuid(mission.mission_id, number), what.kind, revision};
  asked.after_item_id = what.after_item_id;
  asked.items = what.items;
  asked.reason = reason_for(what.kind);
  asked.set_aside = what.set_aside;
  asked.what.said_ns = wall_ns_of(what.said_ns, now);
  waits_for_.emplace(awaited{asked.what.key, fly_at_ns(what.said_ns, now)});
  out.emplace_back(note{std::move(asked)});
  if (!flight_.has_service())
    out.emplace_back(note{mission_arrived{*std::move(revised)}});
  else if (flight_.is_held() && what.kind != change_kind::insert)
    phases_.go(out, trigger::held, "held: the missions service is asked for the change of the mission");
}

void plan_changes::drop(effects& out, const std::string& why) {
  flight_.wanted.change.reset();
  out.emplace_back(note{change_commanded{}});
  out.emplace_back(announce{"the mission is not changed: " + why, true});
}

effects plan_changes::on_change(const mission_client::change_outcome& m) {
  using mission_client::change_verdict;
  if (is_flown_unanswered(m.key))
    return on_answer_to_flown(m);
  if (!flight_.s.change || flight_.s.change->key != m.key)
    return {};
  const bool is_insert = flight_.s.change->kind == change_kind::insert;
  if (m.verdict == change_verdict::done) { // the new revision came before this, and is flown
    refused_inserts_ = 0;
    return {};
  }
  if (m.verdict == change_verdict::unknown && may_fly_unanswered())
    return {}; // as soon as its time is over
  effects out{announce{"the service does not change the mission: " + m.reason, true}};
  // It may have all the same: then the new revision comes as soon as the service answers, and who holds goes on with
  // it.
  if (m.verdict == change_verdict::unknown && flight_.s.change->kind == change_kind::go_to)
    return out;
  out.emplace_back(note{change_resolved{m.key, false}});
  const bool comes_home = flight_.configured.refused_inserts == refusal_policy::come_home;
  if (is_insert && ++refused_inserts_ >= max_refused_inserts && comes_home)
    flight_.wanted.put_halt(task_kind::come_home);
  return out;
}

effects plan_changes::on_assignment(const mission_client::assignment_arrived& m) {
  const auto& s = flight_.s;
  const auto& id = m.assignment.assignment_id;
  const bool is_known =
      s.last_assignment == id ||
      std::any_of(s.waiting.begin(), s.waiting.end(), [&](const auto& each) { return each.assignment_id == id; });
  if (is_known || !s.mission || s.mission->mission_id != m.mission_id)
    return {};
  if (s.waiting.size() >= max_waiting)
    return {note{assignment_rejected{id, "too many assignments wait already"}}};
  return {note{assignment_kept{m.assignment}}};
}

bool plan_changes::answer_assignment(effects& out, instant now) {
  const auto& s = flight_.s;
  if (s.waiting.empty() || !s.mission || flight_.has_open_intent()) // of a task that was given up: its end is coming
    return false;
  const auto at = s.status.now;
  const bool may_change = flight_.may_change_plan();
  const bool waits_on_ground = !flight_.is_in_flight() && (at == phase::disconnected || at == phase::connected ||
                                                           at == phase::preflight || at == phase::ready);
  const auto asked = s.waiting.front();
  if ((flight_.is_mission_finished() && !may_change) || at == phase::aborted)
    return reject(out, asked, "the mission was over before the assignment came");
  if (!may_change && !waits_on_ground)
    return false;
  if (may_change && !flight_.view.is_under_way())
    return false; // on the ground with turning motors: a plan that is replaced now would never take off
  const auto wanted = reassign(*s.mission, asked, last_done(s));
  if (!wanted)
    return reject(out, asked, wanted.error());
  if (const auto why = flight_.why_out_of_limits(wanted->mission, wanted->first_item, now); !why.empty())
    return reject(out, asked, why);
  return waits_on_ground ? take_on_ground(out, asked, wanted->mission) : deploy_assigned(out, asked, *wanted, now);
}

bool plan_changes::reject(effects& out, const mission::assignment& asked, const std::string& why) {
  flight_.refused = refused_mission(flight_, flight_.s.mission->mission_id, asked.revision, why);
  out.emplace_back(note{assignment_rejected{asked.assignment_id, why}});
  return true;
}

bool plan_changes::take_on_ground(effects& out, const mission::assignment& asked, const mission::document& mission) {
  if (flight_.s.assigned)
    return false; // its answer goes out with the upload
  out.emplace_back(note{mission_taken{mission, asked.assignment_id}});
  out.emplace_back(note{preflight::mission_changed{flight_.s.mission->mission_id, asked.revision}});
  if (flight_.s.status.now != phase::disconnected)
    phases_.go(out, trigger::mission_changed); // and from there through the checks again
  return true;
}

bool plan_changes::deploy_assigned(effects& out, const mission::assignment& asked, const reassigned& wanted,
                                   instant now) {
  if (!flight_.may_plan(now))
    return true; // until the vehicle is heard
  const auto plan = flight_.plan_in_flight(wanted.mission, wanted.first_item, now);
  if (!plan)
    return reject(out, asked, plan.error());
  tasks_.begin_deploy(out, wanted.mission, *plan, asked.assignment_id, !flight_.is_held());
  return true;
}

bool plan_changes::deploy_arrived(effects& out, instant now) {
  const auto& s = flight_.s;
  if (flight_.has_open_intent() || !s.arrived || !s.mission || !flight_.may_change_plan() ||
      !flight_.view.is_under_way() || s.arrived->mission_id != s.mission->mission_id)
    return false;
  if (!flight_.may_plan(now))
    return true; // until the vehicle has sent where it is, and where its home is
  const auto plan = flight_.plan_in_flight(*s.arrived, now);
  if (!plan) {
    flight_.refused = refused_mission(flight_, s.arrived->mission_id, s.arrived->revision, plan.error());
    out.emplace_back(announce{"revision " + std::to_string(s.arrived->revision) +
                                  " of the mission can not be flown, and the one before stays: " + plan.error(),
                              true});
    out.emplace_back(note{arrival_refused{s.arrived->revision}});
    return true;
  }
  const bool was_asked_for = s.change && s.change->kind != change_kind::insert && !s.change->is_stopped;
  tasks_.begin_deploy(out, *s.arrived, *plan, {}, !flight_.is_held() || was_asked_for);
  return true;
}

void plan_changes::deploy_again(effects& out, instant now) {
  const auto plan = flight_.plan_in_flight(*flight_.s.mission, now);
  if (plan)
    tasks_.begin_deploy(out, *flight_.s.mission, *plan, {}, true);
  else
    out.emplace_back(announce{"the rest of the mission can not be flown from here: " + plan.error(), true});
}

bool plan_changes::bring_return_anew(effects& out, instant now) {
  if (!flight_.wanted.bring_return_anew || flight_.runner.is_busy())
    return false;
  flight_.wanted.bring_return_anew = false;
  if (flight_.s.status.now != phase::flying || !flight_.may_change_plan() || !flight_.view.is_in(mode_kind::mission))
    return false;
  deploy_again(out, now);
  return true;
}

} // namespace godwit::executor
