#include "actors/executor/flight/stations/part_choice.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "actors/executor/station_plan.hpp"

namespace godwit::executor {
namespace {

// Set current: to this item, and on from there.
bool leaves_end(const start_mission& asked) { return asked.last == std::numeric_limits<std::uint16_t>::max(); }

} // namespace

bool part_choice::is_of_plan(const start_mission& asked) const {
  return flight_.s.station && flight_.s.station->plan_id == asked.plan_id && uploaded_mission(flight_.s) != nullptr;
}

bool part_choice::is_ready() const { return flight_.s.status.now == phase::ready && !flight_.s.arrived; }

bool part_choice::is_had_as_it_is(const start_mission& asked) const {
  if (leaves_end(asked) || !is_of_plan(asked))
    return true;
  const auto has = chosen_part(flight_.s);
  return asked.last == has.last && asked.first >= has.first;
}

bool part_choice::refuse(effects& out, const start_mission& asked, start_verdict verdict, const std::string& why) {
  tasks_.answer_start(out, asked.key, verdict, why);
  return true;
}

// -- on the ground ----------------------------------------------------------------------------------

bool part_choice::waits(instant now) const {
  const auto& start = flight_.wanted.start;
  return start && start->part_until_ns != 0 && now.now_ns < start->part_until_ns && is_of_plan(*start->asked) &&
         !is_ready() && flight_.s.status.now != phase::paused;
}

void part_choice::give_up_late(effects& out, instant now) {
  auto& start = flight_.wanted.start;
  if (!start || start->part_until_ns == 0 || now.now_ns < start->part_until_ns || is_ready())
    return;
  refuse(out, *start->asked, start_verdict::not_ready, flight_.sentence());
  start.reset();
}

bool part_choice::begin(effects& out, start_flight& what, instant now) {
  auto& asked = *what.asked;
  const bool has_waited = std::exchange(what.part_until_ns, 0) != 0;
  if (has_waited && !is_of_plan(asked))
    return refuse(out, asked, start_verdict::no_such_item, "another plan is here by now; load it from the vehicle");
  if (leaves_end(asked) || !is_of_plan(asked) || !is_ready())
    return false;
  const item_range wanted{asked.first, asked.last};
  const auto has = chosen_part(flight_.s);
  if (flight_.drives() && wanted.last == has.last && wanted.first > has.first)
    return false; // it may begin with any item
  const auto part = *part_of_plan(flight_.s, wanted, !flight_.drives());
  if (wanted == has || part.mission.items == uploaded_mission(flight_.s)->items) {
    asked.first = 0;
    return false;
  }
  // And no mode in which a plan that comes would move it.
  const bool stands = flight_.drives() && !flight_.view.is_moving();
  if (flight_.view.is_armed() && !stands)
    return refuse(out, asked, start_verdict::not_ready,
                  "this part of the plan has to be uploaded to the vehicle first; disarm it");
  if (const auto plan = flight_.plan_in_flight(part.mission, 0, now); !plan)
    return refuse(out, asked, start_verdict::failed, plan.error());
  prepare(out, part, std::move(what), now);
  return true;
}

void part_choice::prepare(effects& out, const station_plan_taken& part, start_flight what, instant now) {
  const auto& asked = *what.asked;
  const bool takes_off_before = !part.plan.places.empty() && part.plan.places.front() < asked.first;
  out.emplace_back(announce{sentence_of({asked.first, asked.last}, part.plan.items) + " are prepared" +
                                (takes_off_before ? ", after the take-off" : ""),
                            false});
  out.emplace_back(note{as_new_mission(part, now.wall_ns)});
  what.part_until_ns = now.now_ns + start_waits_ns;
  what.asked->obey_until_ns = std::max(asked.obey_until_ns, now.wall_ns + start_waits_ns);
  flight_.wanted.start = std::move(what);
}

// -- in flight --------------------------------------------------------------------------------------

std::string part_choice::why_not_changed() const {
  if (!flight_.may_change_plan())
    return "the plan can not be changed now: " + flight_.sentence();
  return flight_.is_journal_nearly_full ? "the plan is not changed while so much waits for the journal's disk" : "";
}

// A flight that is paused goes on as it is when it is started from the first item to the end, but for one that waits
// after the end of its part.
bool part_choice::begin_in_flight(effects& out, const start_mission& asked, instant now) {
  const auto& s = flight_.s;
  if (leaves_end(asked) || !is_of_plan(asked))
    return false;
  const auto has = chosen_part(s);
  const bool goes_on = asked.first == 0 && s.status.now == phase::paused;
  const bool is_to_end = asked.last + 1 >= s.station->items;
  const bool waits_after_part = s.status.cause == pause_cause::plan_ended;
  if (goes_on ? asked.last == has.last || (is_to_end && !waits_after_part) : is_had_as_it_is(asked))
    return false;
  if (const auto why = why_not_changed(); !why.empty())
    return refuse(out, asked, start_verdict::not_ready, why);
  auto part = *part_of_plan(s, {0, asked.last}, false);
  part.mission.revision = s.mission->revision + 1;
  part.plan.revision = part.mission.revision;
  const auto first = goes_on ? flight_.first_item(part.mission) : first_item_at(part, asked.first);
  if (first >= part.mission.items.size())
    return refuse(out, asked, start_verdict::failed, "nothing of it is left to fly");
  const auto plan = flight_.plan_in_flight(part.mission, first, now);
  if (!plan)
    return refuse(out, asked, start_verdict::failed, plan.error());
  if (!part.plan.part) // the plan on the vehicle begins here
    part.plan.part = station_part{0, asked.last, part.mission, part.plan.places};
  part.plan.part->first = part.plan.places[first];
  tasks_.begin_part(out, part, *plan, asked.key);
  return true;
}

} // namespace godwit::executor
