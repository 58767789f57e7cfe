#include "actors/executor/flight/flight_start.hpp"

#include <utility>

namespace godwit::executor {

using flight::mode_kind;

void flight_start::begin(effects& out, std::optional<std::uint64_t> key) {
  phases_.go(out, trigger::start_begun);
  watch_.begin_start(out);
  tasks_.begin_start(out, key);
}

// The sentence says why not; empty: it may.
std::string flight_start::why_not(effects& out, instant now) {
  if (flight_.s.status.now != phase::ready || !flight_.s.progress.plan || !flight_.s.mission)
    return flight_.sentence();
  if (auto why = preparation_.why_not_start(out, now); !why.empty())
    return why;
  if (!flight_.view.is_armed() && !flight_.configured.arm_on_start)
    return "the vehicle is disarmed, and starting does not arm it (arm_on_start)";
  return {};
}

bool flight_start::begin_wanted(effects& out, instant now) {
  if (!flight_.wanted.start)
    return false;
  const auto what = *std::exchange(flight_.wanted.start, {});
  if (what.asked)
    begin_asked(out, *what.asked, now);
  else if (const auto why = why_not(out, now); !why.empty())
    out.emplace_back(announce{"the flight is not started: " + why, true});
  else
    begin(out, {});
  return true;
}

void flight_start::begin_asked(effects& out, const start_mission& asked, instant now) {
  const bool is_disarmed = !flight_.view.is_armed() && !flight_.configured.arm_on_start;
  if (now.wall_ns > asked.obey_until_ns)
    tasks_.answer_start(out, asked.key, start_verdict::too_late, "the request came too late");
  else if (const auto why = why_not(out, now); !why.empty())
    tasks_.answer_start(out, asked.key, is_disarmed ? start_verdict::disarmed : start_verdict::not_ready, why);
  else
    begin(out, asked.key);
}

void flight_start::refuse(effects& out, const std::string& why) {
  if (flight_.wanted.start && flight_.wanted.start->asked)
    tasks_.answer_start(out, flight_.wanted.start->asked->key, start_verdict::not_ready, why);
  flight_.wanted.start.reset();
}

bool flight_start::begin_by_itself(effects& out) {
  const auto& configured = flight_.configured;
  const bool is_automatic = configured.start == start_policy::automatic;
  const bool waits_for_word = flight_.s.awaits_word && configured.takeoff_again == start_policy::on_command;
  const bool is_rover = flight_.view.owner().vehicle == flight::vehicle_class::rover;
  const bool is_held_rover = is_rover && flight_.view.is_in(mode_kind::hold); // nobody drives it
  if (is_automatic && waits_for_word)
    phases_.go(out, trigger::start_waits);
  if (!is_automatic || !configured.arm_on_start || waits_for_word || !(!flight_.view.is_under_way() || is_held_rover))
    return false;
  begin(out, {});
  return true;
}

bool flight_start::follow(effects& out) {
  const auto& status = flight_.s.status;
  const bool waits =
      status.now == phase::ready || (status.now == phase::paused && status.cause == pause_cause::restarted);
  const bool flies = flight_.view.is_under_way() && flight_.view.is_in_begun_mission();
  if (flight_.is_in_flight() || !waits || !flies || !flight_.s.progress.plan || !flight_.s.flown)
    return false;
  flight_.adopt_flight();
  out.emplace_back(note{preflight::took_off{}});
  phases_.go(out, trigger::found_started);
  tasks_.begin(out, task_kind::resume, {guard{}, change_mode{mode_kind::mission}});
  return true;
}

} // namespace godwit::executor
