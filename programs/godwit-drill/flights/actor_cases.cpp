// An actor throws once: the flight goes on, and nothing is lost, doubled, armed or started because of it.
#include <array>

#include "programs/godwit-drill/flights/actor_names.hpp"
#include "programs/godwit-drill/flights/disturbed_flight.hpp"
#include "runtime/crash_points.hpp"

namespace godwit::drill {
namespace {

using runtime::crash_point;

struct named_point {
  crash_point point;
  const char* name;
};
constexpr std::array points{named_point{crash_point::before_handler, "before_handler"},
                            named_point{crash_point::after_handler, "after_handler"},
                            named_point{crash_point::after_commit, "after_commit"},
                            named_point{crash_point::before_dispatch, "before_dispatch"}};

struct actor_crash {
  const char* actor;
  crash_point at;
};

// From the throw until the successor takes a message. Nothing: it has not thrown, or there is no successor.
std::optional<double> recovery_ms(flight_simulation& flight, const actor_crash& what) {
  constexpr double most_s = 20; // that it takes to pass the point, and to come back
  auto* process = flight.process();
  const auto before = process->crashes(what.actor);
  const auto incarnation = flight.record().incarnation_of(what.actor);
  process->crash_at(what.actor, what.at);
  const auto has_thrown = [&] { return flight.process() != process || process->crashes(what.actor) > before; };
  if (!flight.run_until(has_thrown, most_s) || flight.process() != process)
    return std::nullopt;
  const auto since_ns = flight.now_ns();
  if (!flight.run_until([&] { return flight.record().incarnation_of(what.actor) > incarnation; }, most_s))
    return std::nullopt;
  return static_cast<double>(flight.now_ns() - since_ns) * 1e-6;
}

std::string crash(watched_flight& watched, const actor_crash& what) {
  const auto took_ms = recovery_ms(watched.flight(), what);
  if (!took_ms)
    return "it did not pass this point";
  ++watched.so_far().crashes;
  watched.note_recovery(*took_ms);
  return {};
}

} // namespace

std::vector<flight_case> actor_cases(vehicles which) {
  std::vector<flight_case> result;
  for (const auto who : which)
    for (const auto part : flight_parts)
      for (const auto* actor : actor_names)
        for (const auto& at : points)
          result.push_back(case_of({.wanted = {.who = who},
                                    .part = part,
                                    .what = std::string(actor) + "/" + at.name,
                                    .disturb = [what = actor_crash{actor, at.point}](watched_flight& watched) {
                                      return crash(watched, what);
                                    }}));
  return result;
}

} // namespace godwit::drill
