// The arbiter: who is asked what is to be done, in which order, and why.
#include <algorithm>
#include <variant>

#include "actors/executor/core.hpp"
#include "actors/executor/flight/new_run.hpp"

namespace godwit::executor {
namespace {

constexpr std::int64_t check_period_ns = 1'000'000'000;

} // namespace

// The first that has something to do keeps the others waiting: who has the vehicle, and what stops it, come first.
const std::array<core::ruling, core::ruling_count> core::rulings{{
    {"look", &core::look, "a new incarnation has not seen the vehicle: nothing is decided before"},
    {"judge_holder", &core::judge_holder, "to whom the vehicle belongs comes before everything that is sent to it"},
    {"come_home", &core::come_home, "a way home around the fences goes on, or ends for a straight one, in time"},
    {"halt", &core::halt, "a word that stops gives up what is under way, and does not wait for it"},
    {"resolve", &core::resolve,
     "an upload or a start has no answer: until it has, nobody knows what the vehicle would fly"},
    {"run_task", &core::run_task, "one task at a time; what follows is decided by its end"},
    {"end_flight", &core::end_flight, "a vehicle that is down is not flown on"},
    {"stand_by", &core::stand_by, "disarmed in its mission mode it would move when armed: before anything is prepared"},
    {"keep_home", &core::keep_home, "where a return leads has to hold before the plan changes"},
    {"answer_assignment", &core::answer_assignment, "the service's word is older than a revision that follows from it"},
    {"fly_unanswered", &core::fly_unanswered,
     "a change whose time is over becomes the revision that the next change is based on"},
    {"deploy_arrived", &core::deploy_arrived, "in flight a new revision takes the place of what is flown"},
    {"follow_started", &core::follow_started, "somebody has started our plan: it is a flight, and not to be prepared"},
    {"take_back", &core::take_back, "a hand-back counts for what waits for it"},
    {"leave_to_person", &core::leave_to_person, "nothing that follows is done while somebody else has the vehicle"},
    {"bring_last_line", &core::bring_last_line, "the vehicle's own fences come before the start that they protect"},
    {"begin_wanted", &core::begin_wanted, "what is wanted of this flight comes before what begins by itself"},
    {"prepare", &core::prepare, "the next flight, on the ground, when nothing else is to be done"},
}};

std::span<const core::ruling> core::arbiter() { return rulings; }

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
  traffic_.look(out, now);
  watch_.look_at_left_armed(out, now);
  tasks_.follow_unheard(out, now);
  ground_.on_task();
  changes_.keep_commanded(out, recovery_.has_looked(), now);
  plan_.check(out, now);
  for (const auto& each : messages_.look(out, now.now_ns))
    flight_.view.take(each, now.now_ns);
  parts_.give_up_late(out, now);
  arming_.look(out, now);
  acts_.look(out, now);
  lost_state_.look(out, now);
  clearing_.look(out, recovery_.has_looked(), now);
  if (stations_.look(out, now))
    return out;
  if (end_.end_by_person(out, now))
    return out;
  homecoming_.answer_failsafe(out, recovery_.has_looked(), now);
  for (bool goes_on = true; goes_on;) {
    const auto before = out.size();
    const auto* const first =
        std::ranges::find_if(rulings, [&](const ruling& each) { return (this->*each.ask)(out, now); });
    if (first != rulings.end())
      ++decided_[static_cast<std::size_t>(first - rulings.begin())];
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

} // namespace godwit::executor
