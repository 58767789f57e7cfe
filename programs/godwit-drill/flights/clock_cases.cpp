// The wall clock is set a day ahead or a year back, in each part of a flight: under a running process, or between two
// of them. And the process gets no processor for 10 s, while a person may take the vehicle.
#include <array>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flights/disturbed_flight.hpp"
#include "programs/godwit-drill/flights/watched_flight.hpp"

namespace godwit::drill {
namespace {

using executor::phase;

constexpr std::int64_t day_ns = 86'400'000'000'000;

struct named_jump {
  const char* name;
  std::int64_t ahead_ns;
};
constexpr std::array jumps{named_jump{"day_ahead", day_ns}, named_jump{"year_back", -365 * day_ns}};
constexpr double suspended_s = 10;

// A start that was under way is not gone on with by itself: who stands there has seen that nothing came of it.
std::string suspend(watched_flight& watched) {
  constexpr double nobody_says_anything_s = 5;
  auto& flight = watched.flight();
  const bool was_starting = flight.status().now == phase::starting;
  flight.suspend_process(suspended_s);
  flight.run_for(suspended_s);
  const auto awake_ns = flight.now_ns();
  if (was_starting) {
    flight.run_for(nobody_says_anything_s);
    watched.expect(missions_started_since(flight, awake_ns) == 0 ? "" : "a start went on 10 s late");
  }
  return {};
}

// A person takes it meanwhile.
std::string suspend_and_take(watched_flight& watched) {
  auto& flight = watched.flight();
  if (!flight.vehicle().describe().armed)
    return "nobody takes a vehicle that is not armed";
  flight.suspend_process(suspended_s);
  flight.run_for(suspended_s / 2);
  if (!take_by_hand(flight))
    return "it is in this mode already";
  flight.run_for(suspended_s / 2);
  expect_left_alone(watched, !executor::is_over(flight.status().now));
  return {};
}

} // namespace

std::vector<flight_case> clock_cases(vehicles which) {
  std::vector<flight_case> result;
  for (const auto who : which)
    for (const auto part : flight_parts) {
      for (const auto& jump : jumps) {
        const auto set = [jump](watched_flight& watched) {
          watched.flight().set_wall_ahead(jump.ahead_ns);
          return std::string();
        };
        const auto set_between = [jump](watched_flight& watched) {
          watched.flight().kill_process();
          watched.flight().set_wall_ahead(jump.ahead_ns);
          return std::string();
        };
        result.push_back(case_of({.wanted = {.who = who}, .part = part, .what = jump.name, .disturb = set}));
        result.push_back(case_of({.wanted = {.who = who},
                                  .part = part,
                                  .what = std::string(jump.name) + "_between_processes",
                                  .disturb = set_between}));
      }
      result.push_back(
          case_of({.wanted = slow_flight(who), .part = part, .what = "suspended_10s", .disturb = suspend}));
      result.push_back(case_of({.wanted = slow_flight(who),
                                .part = part,
                                .what = "taken_while_suspended",
                                .end = flight_end::or_waits,
                                .disturb = suspend_and_take}));
    }
  return result;
}

} // namespace godwit::drill
