#include "actors/executor/flight/flight_start.hpp"

#include <utility>

#include "actors/executor/flight/vehicle_steps.hpp"
#include "actors/executor/station_plan.hpp"

namespace godwit::executor {

using flight::mode_kind;

void flight_start::begin(effects& out, std::optional<std::uint64_t> key, std::uint16_t sequence) {
  phases_.go(out, trigger::start_begun);
  watch_.begin_start(out);
  tasks_.begin_start(out, key, sequence);
}

std::uint16_t flight_start::first_sequence() const { return flight_.s.progress.plan->map.start_sequence; }

// For the item that is asked for; for the first of all where the plan begins, after the home of a vehicle.
std::optional<std::uint16_t> flight_start::sequence_of(const start_mission& asked) const {
  if (asked.first == 0 && flight_.s.progress.plan)
    return first_sequence();
  return vehicle_sequence_of(flight_.s, asked.first, flight_.configured.shows_home);
}

// The sentence says why not; empty: it may.
std::string flight_start::why_not(effects& out, instant now) {
  auto why = why_not_ready(out, now);
  return why.empty() ? flight_.why_not_armed() : why;
}

std::string flight_start::why_not_ready(effects& out, instant now) {
  if (flight_.s.status.now != phase::ready || !flight_.s.progress.plan || !flight_.s.mission)
    return flight_.sentence();
  return preparation_.why_not_start(out, now);
}

// Stations say arm and start in one breath, and an autopilot shows that it is armed with its next heartbeat.
bool flight_start::waits_for_arming(instant now) const {
  const auto& asked = flight_.wanted.start->asked;
  return asked && !flight_.view.is_armed() && now.now_ns < flight_.arming_until_ns &&
         now.wall_ns <= asked->obey_until_ns && flight_.s.status.now == phase::ready;
}

bool flight_start::begin_wanted(effects& out, instant now) {
  if (!flight_.wanted.start || waits_for_arming(now) || parts_.waits(now))
    return false;
  auto what = *std::exchange(flight_.wanted.start, {});
  const bool is_on_ground = what.asked && !what.has_taken_off && !flight_.is_in_flight();
  if (is_on_ground && now.wall_ns <= what.asked->obey_until_ns && parts_.begin(out, what, now))
    return true;
  if (what.asked && what.has_taken_off && flight_.s.status.now == phase::ready)
    begin_in_air(out, *what.asked);
  else if (what.asked)
    begin_asked(out, *what.asked, now);
  else if (what.armed_from && flight_.s.status.now == phase::ready)
    begin(out, {}, *what.armed_from);
  else if (const auto why = why_not(out, now); !why.empty())
    out.emplace_back(announce{"the flight is not started: " + why, true});
  else
    begin(out, {}, first_sequence());
  return true;
}

// -- of a flight under way --------------------------------------------------------------------------

std::string flight_start::why_not_in_flight() const {
  const auto cause = flight_.s.status.cause;
  if (!flight_.s.progress.plan || cause == pause_cause::foreign_plan || cause == pause_cause::vehicle_restarted ||
      cause == pause_cause::infeasible_plan)
    return flight_.sentence();
  if (!flight_.view.is_under_way())
    return "the vehicle stands on the ground; its flight has not ended yet";
  if (flight_.was_called_home() || flight_.is_on_way_home())
    return "the vehicle was called home";
  if (flight_.has_open_intent() || flight_.authority.is_unclear())
    return "something else is under way";
  return {};
}

// What is paused goes on when it is started from the first item, and by its mission mode whatever it does; else it goes
// to the item that is named.
void flight_start::begin_in_flight(effects& out, const start_mission& asked, instant now) {
  if (const auto why = why_not_in_flight(); !why.empty())
    return tasks_.answer_start(out, asked.key, start_verdict::not_ready, why);
  if (parts_.begin_in_flight(out, asked, now))
    return;
  const auto sequence = vehicle_sequence_of(flight_.s, asked.first, flight_.configured.shows_home);
  if (!sequence)
    return tasks_.answer_start(out, asked.key, start_verdict::no_such_item, "the vehicle has no such item");
  const bool goes_on = asked.first == 0 && (flight_.s.status.now == phase::paused || asked.by_mode);
  tasks_.begin(out, task_kind::resume,
               tasks_.guarded(goes_on ? going_on_steps(flight_) : jump_steps(flight_, *sequence)), false, asked.key);
}

// A station has armed it, taken off and given it back: of a flight that was ready the mode alone is missing. That the
// vehicle is under way, for which it could not be prepared now, is what that station wants.
void flight_start::begin_in_air(effects& out, const start_mission& asked) {
  const auto sequence = sequence_of(asked);
  if (asked.first != 0 && !sequence)
    return tasks_.answer_start(out, asked.key, start_verdict::no_such_item, "the vehicle has no such item");
  if (!parts_.is_had_as_it_is(asked))
    return tasks_.answer_start(out, asked.key, start_verdict::not_ready,
                               "another part of the plan is ready, and in the air only that can be started");
  if (!flight_.is_in_air() || !flight_.s.progress.plan || flight_.has_open_intent())
    return tasks_.answer_start(out, asked.key, start_verdict::not_ready, flight_.sentence());
  flight_.adopt_flight();
  out.emplace_back(note{preflight::took_off{}});
  phases_.go(out, trigger::found_started);
  tasks_.begin(out, task_kind::resume, tasks_.guarded(jump_steps(flight_, *sequence)), false, asked.key);
}

// -- on the ground ----------------------------------------------------------------------------------

void flight_start::begin_asked(effects& out, const start_mission& asked, instant now) {
  if (now.wall_ns > asked.obey_until_ns)
    tasks_.answer_start(out, asked.key, start_verdict::too_late, "the request came too late");
  else if (flight_.is_in_flight())
    begin_in_flight(out, asked, now);
  else if (const auto why = why_not_ready(out, now); !why.empty())
    tasks_.answer_start(out, asked.key, start_verdict::not_ready, why);
  else if (const auto disarmed = flight_.why_not_armed(); !disarmed.empty() && !asked.by_mode)
    tasks_.answer_start(out, asked.key, start_verdict::disarmed, disarmed);
  else if (const auto sequence = sequence_of(asked); !sequence)
    tasks_.answer_start(out, asked.key, start_verdict::no_such_item, "the vehicle has no such item");
  else if (asked.first != 0 && !flight_.drives())
    tasks_.answer_start(out, asked.key, start_verdict::no_such_item, "what flies begins with its take-off");
  else if (!disarmed.empty())
    arming_.begin(out, asked, *sequence, now);
  else
    begin(out, asked.key, *sequence);
}

void flight_start::refuse(effects& out, const std::string& why) {
  if (flight_.wanted.start && flight_.wanted.start->asked)
    tasks_.answer_start(out, flight_.wanted.start->asked->key, start_verdict::not_ready, why);
  flight_.wanted.start.reset();
}

// Empty: as the table says it.
std::string flight_start::why_start_waits() const {
  if (flight_.refused_start.empty())
    return {};
  return flight_.refused_start +
         "; godwit does not try it again, because the vehicle was under way without it: a person has to start it";
}

bool flight_start::begin_by_itself(effects& out, instant now) {
  const auto& configured = flight_.configured;
  const bool is_automatic = configured.start == start_policy::automatic;
  const bool waits_for_word = flight_.s.awaits_word && configured.takeoff_again == start_policy::on_command;
  const bool is_held_rover = flight_.drives() && flight_.view.is_in(mode_kind::hold); // nobody drives it
  if (is_automatic && flight_.s.awaits_person)
    phases_.go(out, trigger::start_waits,
               "somebody has acted on the vehicle since its plan was uploaded, or the mission before was called off; a "
               "person has to start it");
  else if (is_automatic && waits_for_word)
    phases_.go(out, trigger::start_waits, why_start_waits());
  const auto commanded_ns = flight_.evidence.commanded_ns;
  if (commanded_ns != 0 && now.now_ns - commanded_ns < person_acts_ns)
    return false;
  const bool waits_for_person = waits_for_word || flight_.s.awaits_person;
  if (!is_automatic || !configured.arm_on_start || waits_for_person || !(!flight_.view.is_under_way() || is_held_rover))
    return false;
  begin(out, {}, first_sequence());
  return true;
}

bool flight_start::follow(effects& out, instant now) {
  const auto& status = flight_.s.status;
  const bool may_be_ours = status.cause == pause_cause::restarted || status.cause == pause_cause::asked ||
                           status.cause == pause_cause::not_done;
  const bool waits = status.now == phase::ready || (status.now == phase::paused && may_be_ours);
  const bool flies = flight_.view.is_under_way() && flight_.view.is_in_begun_mission();
  if (flight_.is_in_flight() || flight_.has_person() || !waits || !flies || !flight_.s.progress.plan ||
      !flight_.s.flown)
    return false;
  flight_.adopt_flight();
  flight_.evidence.plan.doubt(now.now_ns); // whoever has started it may have brought another one
  flight_.wanted.set_current_item = false; // it goes on from where it is
  out.emplace_back(note{preflight::took_off{}});
  if (const auto& current = flight_.view.current())
    out.emplace_back(note{progress::found_begun{current->seq, flight_.view.says_incomplete()}});
  phases_.go(out, trigger::found_started);
  tasks_.begin(out, task_kind::resume, {guard{}, change_mode{mode_kind::mission}});
  return true;
}

} // namespace godwit::executor
