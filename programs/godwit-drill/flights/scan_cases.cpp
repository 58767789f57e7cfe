// Flights with a survey in which things are seen and a person decides, while scan_controller throws, ends, hangs, is
// given up, or the whole process is killed: each point is shown once, no decision is lost, and the flight is left
// alone.
#include <array>

#include "programs/godwit-drill/flight_simulation/scan_mission.hpp"
#include "programs/godwit-drill/flights/disturbed_flight.hpp"
#include "runtime/crash_points.hpp"

namespace godwit::drill {
namespace {

using runtime::crash_point;
using scan_controller::decision;

constexpr const char* actor = "scan_controller";
constexpr int things = 4;
constexpr double crashes_apart_s = 13; // five crashes in a minute, and it would be given up

// In front of each sighting and each decision.
using scan_trouble = std::function<void(watched_flight& watched)>;

std::string id_of(int number) {
  std::string digits = std::to_string(number);
  return "00000000-0000-4000-8000-" + std::string(12 - digits.size(), '0') + digits;
}

// Who hears that the outcome is unknown says it again.
bool decide(flight_simulation& flight, std::uint64_t number, decision what) {
  for (int tries = 0; tries < 5; ++tries, flight.run_for(1))
    if (flight.process() != nullptr && flight.process()->decide({number, what, "drill"}).is_taken)
      return true;
  return false;
}

bool begins_to_scan(flight_simulation& flight) {
  constexpr double begun_within_s = 120;
  constexpr double wanted_within_s = 8; // a part of a flight counts when it has held for 5 s
  if (!flight.run_until_phase(executor::phase::flying, begun_within_s))
    return false;
  flight.run_for(wanted_within_s);
  return flight.process() != nullptr && flight.process()->points().has_value();
}

void look_at_points(watched_flight& watched) {
  auto& flight = watched.flight();
  const auto points = flight.process() != nullptr ? flight.process()->points() : std::nullopt;
  if (!points)
    return watched.expect("nobody looks for points of interest any more");
  watched.expect(points->counts.opened == things ? "" : "what was seen is another number of points");
  watched.expect(points->counts.confirmed == 1 && points->counts.declined == 1 ? "" : "a decision was lost or doubled");
}

flight_outcome fly(sim::personality who, const std::string& name, const scan_trouble& make,
                   const flight_wishes& wishes) {
  watched_flight watched(slow_flight(who), scan_mission(who), wishes, name, row_of(who, "survey"));
  auto& flight = watched.flight();
  if (!begins_to_scan(flight)) {
    watched.so_far().skipped = "the flight did not come to its survey";
    return watched.finish();
  }
  for (int number = 1; number <= things; ++number) {
    make(watched);
    if (flight.process() != nullptr)
      flight.process()->see(seen_in_survey(flight, id_of(number), 40.0 * number, 0.9));
    else
      flight.outside().seen.push_back(seen_in_survey(flight, id_of(number), 40.0 * number, 0.9));
    flight.run_for(crashes_apart_s);
  }
  make(watched);
  watched.expect(decide(flight, things, decision::decline) ? "" : "a decision was not taken");
  watched.expect(decide(flight, things - 1, decision::confirm) ? "" : "a decision was not taken");
  look_at_points(watched);
  return watched.finish();
}

scan_trouble throws_at(crash_point point) {
  return [point](watched_flight& watched) {
    if (auto* process = watched.flight().process()) {
      process->crash_at(actor, point);
      ++watched.so_far().crashes;
    }
  };
}

void ends(watched_flight& watched) {
  if (auto* process = watched.flight().process())
    watched.so_far().crashes += process->kill(actor) ? 1 : 0;
}

void ends_with_executor(watched_flight& watched) {
  ends(watched);
  if (auto* process = watched.flight().process())
    watched.so_far().crashes += process->kill("executor") ? 1 : 0;
}

void ends_with_process(watched_flight& watched) { watched.flight().kill_process(); }

} // namespace

std::vector<flight_case> scan_cases(vehicles which) {
  const std::array<std::pair<const char*, scan_trouble>, 7> troubles{
      std::pair("before_handler", throws_at(crash_point::before_handler)),
      std::pair("after_handler", throws_at(crash_point::after_handler)),
      std::pair("after_commit", throws_at(crash_point::after_commit)),
      std::pair("before_dispatch", throws_at(crash_point::before_dispatch)),
      std::pair("ends", scan_trouble(ends)),
      std::pair("ends+executor", scan_trouble(ends_with_executor)),
      std::pair("ends+process", scan_trouble(ends_with_process))};
  std::vector<flight_case> result;
  for (const auto who : which) {
    if (who == sim::personality::plane) // the lines are too near to each other for it
      continue;
    for (const auto& [what, make] : troubles) {
      const auto name = row_of(who, "survey/" + std::string(actor) + "/" + what);
      result.push_back({name, row_of(who, "survey"), [who, name, disturb = make](const flight_wishes& wishes) {
                          return fly(who, name, disturb, wishes);
                        }});
    }
  }
  return result;
}

} // namespace godwit::drill
