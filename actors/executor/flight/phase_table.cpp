#include "actors/executor/flight/phase_table.hpp"

#include <stdexcept>

#include "io/fields/field_table.hpp"

namespace godwit::executor {
namespace {

using enum phase;
using cause = pause_cause;

template <class... P>
constexpr phase_set of(P... each) {
  return (0U | ... | (1U << static_cast<unsigned>(each)));
}

constexpr phase_set any = (1U << phase_count) - 1; // what takes the vehicle from godwit, and nothing else
constexpr phase_set on_ground = of(disconnected, connected, preflight, uploading, ready, starting);
constexpr phase_set on_the_way = of(flying, pausing, landing); // `in_flight`, always
constexpr phase_set in_the_flight = on_the_way | of(paused);
constexpr phase_set before_start = on_ground | of(paused); // paused on the ground
constexpr phase_set open = on_ground | in_the_flight;
constexpr phase_set over = of(post_flight, done, aborted);
constexpr phase_set not_flown = before_start | over; // somebody else may drive it, and an operator stop that
// Here a person may have the vehicle without a pause: nothing that is under way has to end.
constexpr phase_set at_rest_or_prepared = of(disconnected, connected, preflight, ready) | over;

bool is_in_flight(const flight_context& c) { return c.is_in_flight(); }
// Or it flies the way home, which is no part of the mission.
bool is_plan_finished(const flight_context& c) { return c.is_plan_finished() || c.is_on_way_home(); }
bool is_plan_over(const flight_context& c) { return c.is_plan_over(); }
bool has_person(const flight_context& c) { return c.has_person(); }
bool has_failsafe(const flight_context& c) {
  const auto why = c.s.status.cause;
  return why == cause::failsafe || why == cause::autopilot_failsafe;
}
bool waits_in_air(const flight_context& c) { return c.is_in_flight() && c.hovers() && c.is_in_air(); }
bool is_flown_to_end(const flight_context& c) { return c.is_in_flight() && is_plan_finished(c); }
bool has_more_plans(const flight_context& c) { return !c.has_person() && c.is_plan_finished(); }
bool owes_delivery(const flight_context& c) { return c.is_mission_finished() && c.has_service(); }
bool is_mission_finished(const flight_context& c) { return c.is_mission_finished(); }
bool holds_foreign_plan(const flight_context& c) {
  return c.is_in_flight() && c.s.progress.paused == progress::pause_reason::foreign_plan;
}
bool holds_infeasible_plan(const flight_context& c) {
  return c.is_in_flight() && c.s.progress.paused == progress::pause_reason::infeasible_plan;
}
bool has_lost_plan(const flight_context& c) {
  return c.is_in_flight() && c.s.progress.paused == progress::pause_reason::vehicle_restarted;
}
bool flies_plan(const flight_context& c) { return c.is_in_flight() && c.view.is_in(flight::mode_kind::mission); }
bool flies_end_of_plan(const flight_context& c) { return flies_plan(c) && is_plan_finished(c); }

struct named_guard {
  std::string_view name;
  bool (*holds)(const flight_context&);
};

constexpr named_guard no_guard{"", nullptr};
constexpr named_guard ends_in_air{"in flight, plan finished, in the air", waits_in_air};
constexpr named_guard in_flight{"in flight", is_in_flight};
constexpr named_guard plan_finished{"plan finished", is_plan_finished};
constexpr named_guard plan_over{"plan finished, or called home", is_plan_over};
constexpr named_guard flown_to_end{"in flight, plan finished", is_flown_to_end};
constexpr named_guard with_person{"somebody else has the vehicle", has_person};
constexpr named_guard with_failsafe{"a failsafe has the vehicle", has_failsafe};
constexpr named_guard more_plans{"plan finished, under godwit", has_more_plans};
constexpr named_guard to_deliver{"mission finished, with a service", owes_delivery};
constexpr named_guard mission_finished{"mission finished", is_mission_finished};
constexpr named_guard with_foreign_plan{"in flight, foreign plan", holds_foreign_plan};
constexpr named_guard with_infeasible_plan{"in flight, infeasible plan", holds_infeasible_plan};
constexpr named_guard without_plan{"in flight, autopilot restarted", has_lost_plan};
constexpr named_guard in_mission_mode{"in flight, in mission mode", flies_plan};
constexpr named_guard at_end_of_plan{"in flight, in mission mode, plan finished", flies_end_of_plan};

constexpr std::string_view other_plan = "the vehicle holds a plan that is not godwit's";
constexpr std::string_view infeasible = "the vehicle finds that the uploaded plan can not be flown";
constexpr std::string_view plan_lost = "the autopilot started again; what it flew is lost";

constexpr std::optional<phase> stays = std::nullopt;

constexpr transition row(trigger on, phase_set from, const named_guard& guard, std::optional<phase> next) {
  transition result;
  result.on = on;
  result.from = from;
  result.guard = guard.name;
  result.holds = guard.holds;
  result.next = next;
  return result;
}

constexpr transition flies(transition way, flight_bit becomes) {
  way.in_flight = becomes;
  return way;
}

constexpr transition with(transition way, pause_cause why, std::string_view reason = {}) {
  way.cause = why;
  way.reason = reason;
  return way;
}

constexpr transition with(transition way, cause_rule rule, std::string_view reason = {}) {
  way.rule = rule;
  way.reason = reason;
  return way;
}

constexpr transition flying_on(trigger on, phase_set from, const named_guard& guard, phase next) {
  return flies(row(on, from, guard, next), flight_bit::yes);
}

// The flight is over.
constexpr transition ended(trigger on, phase_set from, const named_guard& guard, phase next) {
  return flies(row(on, from, guard, next), flight_bit::no);
}

constexpr transition pauses(trigger on, phase_set from, pause_cause why, std::string_view reason = {}) {
  return with(row(on, from, no_guard, paused), why, reason);
}

// After a plan that ends in the air.
constexpr transition waits(trigger on, phase_set from) {
  return flies(with(row(on, from, ends_in_air, paused), cause::plan_ended,
                    "the plan is flown and ends in the air; the vehicle waits there: come_home brings it back, goto "
                    "and assignments send it on"),
               flight_bit::yes);
}

constexpr std::array table{
    // on the ground
    row(trigger::link_lost, of(disconnected, connected, preflight, ready, done, aborted), no_guard, disconnected),
    row(trigger::link_found, of(disconnected), no_guard, connected),
    row(trigger::mission_changed, of(disconnected, connected, preflight, ready, paused, done, aborted), no_guard,
        connected),
    row(trigger::prepare_again, of(paused), no_guard, connected),
    row(trigger::checks_begun, of(connected, preflight, ready), no_guard, preflight),
    row(trigger::checks_passed, of(preflight), no_guard, uploading),
    with(row(trigger::rest_refused, of(preflight), no_guard, paused), cause::not_done),
    row(trigger::plan_brought, on_the_way, no_guard, flying),
    row(trigger::plan_brought, of(paused), in_flight, flying),
    row(trigger::plan_brought, before_start, no_guard, ready),
    pauses(trigger::plan_brought_held, in_the_flight, cause::asked, "held as asked"),
    with(row(trigger::start_waits, of(ready), no_guard, stays), cause::none,
         "this mission was begun before, or the vehicle was under way without godwit; a person has to start it"),
    row(trigger::start_begun, of(ready), no_guard, starting),
    row(trigger::start_refused, before_start, no_guard, ready),
    flies(pauses(trigger::start_failed, before_start, cause::not_done), flight_bit::if_in_air),
    pauses(trigger::start_stopped, before_start, cause::asked,
           "stopped before it moved; resume prepares the flight again"),
    with(row(trigger::start_waits, of(paused), no_guard, stays), cause_rule::kept),
    flying_on(trigger::started, not_flown, no_guard, flying),
    flying_on(trigger::found_started, of(ready, paused), no_guard, flying),
    // in flight
    waits(trigger::plan_done, of(flying)),
    row(trigger::plan_done, of(flying), no_guard, landing),
    with(row(trigger::told_to_hold, on_the_way, no_guard, pausing), cause::none, "the vehicle was commanded to hold"),
    pauses(trigger::held, in_the_flight, cause::asked, "held as asked"),
    pauses(trigger::held, on_ground | over, cause::asked, "held as asked; resume prepares the flight"),
    waits(trigger::resumed, in_the_flight),
    flying_on(trigger::resumed, in_the_flight, plan_finished, landing),
    flying_on(trigger::resumed, in_the_flight, no_guard, flying),
    with(row(trigger::called_home, on_the_way, no_guard, landing), cause::none, "the vehicle returns"),
    with(row(trigger::called_home, of(paused), in_flight, landing), cause::none, "the vehicle returns"),
    pauses(trigger::called_home, not_flown, cause::asked, "the vehicle was sent home; resume prepares the flight"),
    with(row(trigger::called_home_by_plan, in_the_flight, no_guard, flying), cause::none,
         "called home: it holds, and then flies around the fences"),
    waits(trigger::not_obeyed, of(pausing)),
    row(trigger::not_obeyed, of(pausing), plan_over, landing),
    row(trigger::not_obeyed, of(pausing), no_guard, flying),
    with(row(trigger::not_obeyed, of(flying, landing) | on_ground | over, no_guard, stays), cause_rule::kept),
    pauses(trigger::task_failed, open, cause::not_done),
    // who has the vehicle
    with(row(trigger::person_acts_on_ground, at_rest_or_prepared, no_guard, stays), cause::taken_over),
    pauses(trigger::person_acts_on_ground, of(uploading, starting) | in_the_flight, cause::taken_over),
    flies(pauses(trigger::person_took_over, any, cause::taken_over), flight_bit::if_moving),
    flies(pauses(trigger::failsafe_acts, any, cause::failsafe), flight_bit::if_moving),
    flies(pauses(trigger::autopilot_failsafe_acts, any, cause::autopilot_failsafe), flight_bit::if_moving),
    row(trigger::handed_back, at_rest_or_prepared, no_guard, stays),
    with(row(trigger::handed_back, of(paused), with_foreign_plan, paused), cause::foreign_plan, other_plan),
    with(row(trigger::handed_back, of(paused), with_infeasible_plan, paused), cause::infeasible_plan, infeasible),
    with(row(trigger::handed_back, of(paused), without_plan, paused), cause::vehicle_restarted, plan_lost),
    waits(trigger::handed_back, of(paused)),
    flying_on(trigger::handed_back, of(paused), at_end_of_plan, landing),
    flying_on(trigger::handed_back, of(paused), in_mission_mode, flying),
    pauses(trigger::handed_back, of(paused), cause::asked,
           "handed back; it waits for a command: resume, goto or come_home"),
    pauses(trigger::foreign_plan_found, any, cause::foreign_plan, other_plan),
    pauses(trigger::infeasible_plan_found, open, cause::infeasible_plan, infeasible),
    pauses(trigger::autopilot_restarted, open, cause::vehicle_restarted, plan_lost),
    // after a restart of the executor
    pauses(trigger::restarted_on_ground, before_start, cause::restarted,
           "godwit was restarted on the ground; resume prepares the flight again"),
    pauses(trigger::replan_left_open, in_the_flight, cause::asked,
           "godwit was restarted while it replaced the plan; resume starts the new one"),
    pauses(trigger::found_held, open, cause::asked, "held as asked"), // a start counts as begun until it was looked
    flying_on(trigger::found_on_its_way, open, no_guard, flying),
    waits(trigger::found_in_flight, in_the_flight),
    flying_on(trigger::found_in_flight, of(landing), no_guard, landing),
    flying_on(trigger::found_in_flight, of(pausing), plan_over, landing),
    flying_on(trigger::found_in_flight, of(flying, paused), flown_to_end, landing),
    flying_on(trigger::found_in_flight, open, no_guard, flying),
    // the end
    with(ended(trigger::flight_ended, in_the_flight, without_plan, paused), cause::taken_over,
         "the flight ended as its autopilot started again; nothing is uploaded, armed or started until an operator "
         "hands the vehicle back"),
    with(ended(trigger::flight_ended, in_the_flight, with_failsafe, paused), cause_rule::kept,
         "the flight ended after a failsafe took the vehicle; nothing is uploaded, armed or started until an operator "
         "hands it back"),
    with(ended(trigger::flight_ended, in_the_flight, with_person, paused), cause_rule::kept,
         "the flight ended under manual control; nothing is uploaded, armed or started until an operator hands the "
         "vehicle back"),
    ended(trigger::flight_ended, in_the_flight, more_plans, connected),
    with(ended(trigger::flight_ended, in_the_flight, no_guard, paused), cause::taken_over,
         "the flight ended before its plan, and not by godwit; check the vehicle and hand it back, then resume "
         "prepares the rest"),
    with(ended(trigger::mission_ended, open, to_deliver, post_flight), cause_rule::kept_if_person),
    with(ended(trigger::mission_ended, open, mission_finished, done), cause_rule::kept_if_person),
    with(ended(trigger::mission_ended, open, no_guard, aborted), cause_rule::kept_if_person),
    with(row(trigger::delivered, of(post_flight), no_guard, done), cause_rule::kept),
};

pause_cause cause_after(const transition& taken, const phase_status& before) {
  switch (taken.rule) {
  case cause_rule::kept:
    return before.cause;
  case cause_rule::kept_if_person:
    return needs_hand_back(before.cause) ? before.cause : cause::none;
  case cause_rule::of_row:
    break;
  }
  return taken.cause;
}

bool flies_after(const transition& taken, const flight_context& c) {
  switch (taken.in_flight) {
  case flight_bit::yes:
    return true;
  case flight_bit::no:
    return false;
  case flight_bit::if_moving:
    return c.is_in_flight() || c.view.is_moving();
  case flight_bit::if_in_air:
    return c.is_in_flight() || c.is_in_air();
  case flight_bit::as_before:
    break;
  }
  return c.is_in_flight();
}

} // namespace

std::span<const transition> phase_table() { return table; }

phase_machine::phase_machine(const flight_context& flight) : flight_(flight), taken_(table.size()) {}

void phase_machine::go(effects& out, trigger what, const std::string& reason) {
  const auto& before = flight_.s.status;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto& each = table[i];
    if (each.on != what || !has(each.from, before.now) || (each.holds != nullptr && !each.holds(flight_)))
      continue;
    ++taken_[i][static_cast<std::size_t>(before.now)];
    const phase_status next{each.next.value_or(before.now), cause_after(each, before),
                            reason.empty() ? std::string(each.reason) : reason, flies_after(each, flight_)};
    if (next != before)
      out.emplace_back(note{next});
    return;
  }
  throw std::logic_error("the phase " + std::string(io::name_of(before.now)) + " has no way on for " +
                         std::string(io::name_of(what)));
}

} // namespace godwit::executor
