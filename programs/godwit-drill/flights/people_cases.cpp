// A person takes the vehicle by a mode of it, and godwit knows of it from the vehicle alone: nothing is commanded
// after that until somebody hands it back. Then they say that it goes on; where godwit can not (a plane does not take
// off again) it waits, and says for what.
//
// The mission mode is none of these modes: while the mission flies nobody can tell it from godwit's own.
#include <array>

#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"
#include "programs/godwit-drill/flights/flight_case.hpp"
#include "programs/godwit-drill/flights/left_alone.hpp"

namespace godwit::drill {
namespace {

using executor::pause_cause;
using executor::phase;

constexpr std::array parts{phase::ready, phase::starting, phase::flying, phase::landing, phase::paused};

struct takeover {
  sim::personality who;
  phase part; // paused: in flight, by a word of an operator
  sim::flight_mode mode;
  mode_form how = mode_form::set_mode;
  bool is_on_other_line = false;

  [[nodiscard]] std::string group() const { return row_of(who, io::name_of(part)); }
  [[nodiscard]] std::string name() const { return group() + "/" + std::string(mode.name); }
};

// False: the flight has no such part.
bool bring_to(flight_simulation& flight, phase part) {
  const auto is_there = [&] { return flight.status().now == part || executor::is_at_rest(flight.status().now); };
  if (part != phase::paused && part != phase::flying)
    return flight.run_until(is_there, 120) && flight.status().now == part;
  const auto is_on_its_way = [&] {
    const auto seen = flight.vehicle().describe();
    return flight.status().now == phase::flying && (seen.in_air || flight.who() == sim::personality::rover);
  };
  if (!flight.run_until(is_on_its_way, 120))
    return false;
  flight.run_for(1);
  if (part == phase::flying)
    return flight.status().now == phase::flying;
  flight.say(operators::command_kind::pause);
  const bool is_paused = flight.run_until_phase(phase::paused, 20);
  flight.run_for(6); // an order of the last 5 s could be what changed the mode
  return is_paused && flight.status().cause == pause_cause::asked;
}

// Why it can not be taken here; empty: it is.
std::string take(flight_simulation& flight, const takeover& what) {
  if (!bring_to(flight, what.part))
    return "the flight has no such part";
  if (flight.vehicle().describe().mode == what.mode.name)
    return "it is in this mode already";
  flight.switch_mode(what.mode.custom, what.how);
  flight.run_for(0.1);
  return flight.vehicle().describe().mode == what.mode.name ? "" : "the vehicle does not change to it";
}

void leave_alone(watched_flight& watched, const takeover& what) {
  auto& flight = watched.flight();
  expect_left_alone(watched, what.part != phase::ready); // there it is enough that nothing is commanded
  const auto seen = flight.vehicle().describe();
  if (!seen.armed && seen.mode == what.mode.name)
    flight.switch_mode(pilot_mode(what.who)); // who hands it back on the ground leaves it in a mode that can be armed
}

flight_outcome fly(const takeover& what, const flight_wishes& wishes) {
  const bool waits_for_start = what.part == phase::ready;
  watched_flight watched(
      {.who = what.who, .starts_by_itself = !waits_for_start, .is_person_on_other_line = what.is_on_other_line}, wishes,
      what.name(), what.group());
  watched.so_far().skipped = take(watched.flight(), what);
  if (watched.so_far().skipped.empty())
    leave_alone(watched, what);
  if (waits_for_start)
    watched.expect(start_by_station(watched.flight()) ? "" : "a station could not start it");
  return watched.finish_or_wait();
}

} // namespace

std::vector<flight_case> people_cases(vehicles which) {
  std::vector<flight_case> result;
  for (const auto who : which)
    for (const auto part : parts)
      for (std::size_t index = 0; index < modes_of(who).size(); ++index) {
        const auto& mode = modes_of(who)[index];
        if (mode.kind == sim::mode_kind::mission)
          continue;
        // Each form and both lines by turns: godwit knows it by heartbeats, whatever the form and the line.
        const auto turn = index + static_cast<std::size_t>(part);
        const takeover what{who, part, mode, all_mode_forms.at(turn % all_mode_forms.size()), turn % 2 == 1};
        result.push_back(
            {what.name(), what.group(), [what](const flight_wishes& wishes) { return fly(what, wishes); }});
      }
  return result;
}

} // namespace godwit::drill
