// An actor throws once: the flight goes on, and nothing is lost, doubled, armed or started because of it.
//
// In `ready` the start waits for a station. Behind the throw nobody says anything for a while, and the vehicle must
// stay as it is.
#include <array>

#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flights/actor_names.hpp"
#include "programs/godwit-drill/flights/flight_case.hpp"
#include "runtime/crash_points.hpp"

namespace godwit::drill {
namespace {

using executor::phase;
using runtime::crash_point;

constexpr std::array parts{phase::preflight, phase::uploading, phase::ready,      phase::starting,
                           phase::flying,    phase::landing,   phase::post_flight};

struct named_point {
  crash_point point;
  const char* name;
};
constexpr std::array points{named_point{crash_point::before_handler, "before_handler"},
                            named_point{crash_point::after_handler, "after_handler"},
                            named_point{crash_point::after_commit, "after_commit"},
                            named_point{crash_point::before_dispatch, "before_dispatch"}};

struct actor_crash {
  sim::personality who;
  phase part;
  const char* actor;
  named_point at;

  [[nodiscard]] std::string group() const {
    return std::string(io::name_of(who)) + "/" + std::string(io::name_of(part));
  }
  [[nodiscard]] std::string name() const { return group() + "/" + actor + "/" + at.name; }
};

// From the throw until the successor takes a message. Nothing: it has not thrown, or there is no successor.
std::optional<double> recovery_ms(flight_simulation& flight, const actor_crash& what) {
  constexpr double most_s = 20; // that it takes to pass the point, and to come back
  auto* process = flight.process();
  const auto before = process->crashes(what.actor);
  const auto incarnation = flight.record().incarnation_of(what.actor);
  process->crash_at(what.actor, what.at.point);
  const auto has_thrown = [&] { return flight.process() != process || process->crashes(what.actor) > before; };
  if (!flight.run_until(has_thrown, most_s) || flight.process() != process)
    return std::nullopt;
  const auto since_ns = flight.now_ns();
  if (!flight.run_until([&] { return flight.record().incarnation_of(what.actor) > incarnation; }, most_s))
    return std::nullopt;
  return static_cast<double>(flight.now_ns() - since_ns) * 1e-6;
}

flight_outcome fly(const actor_crash& what, const flight_wishes& wishes) {
  const bool waits_for_start = what.part == phase::ready;
  watched_flight watched({.who = what.who, .starts_by_itself = !waits_for_start}, wishes, what.name(), what.group());
  auto& flight = watched.flight();
  if (!flight.run_until([&] { return flight.status().now == what.part || executor::is_at_rest(flight.status().now); },
                        120) ||
      flight.status().now != what.part) {
    watched.so_far().skipped = "the flight has no such part";
    return watched.finish();
  }
  if (const auto took_ms = recovery_ms(flight, what)) {
    ++watched.so_far().crashes;
    watched.note_recovery(*took_ms);
  } else {
    watched.so_far().skipped = "it did not pass this point";
  }
  if (waits_for_start) {
    flight.run_for(5);
    watched.expect(flight.vehicle().describe().armed ? "it was armed although nobody had started it" : "");
    watched.expect(start_by_station(flight) ? "" : "a station could not start it");
  }
  return watched.finish();
}

} // namespace

std::vector<flight_case> actor_cases(vehicles which) {
  std::vector<flight_case> result;
  for (const auto who : which)
    for (const auto part : parts)
      for (const auto* actor : actor_names)
        for (const auto& at : points) {
          const actor_crash what{who, part, actor, at};
          result.push_back(
              {what.name(), what.group(), [what](const flight_wishes& wishes) { return fly(what, wishes); }});
        }
  return result;
}

} // namespace godwit::drill
