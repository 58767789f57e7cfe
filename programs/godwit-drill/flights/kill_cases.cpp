// The process ends as by SIGKILL at moments that their seeds draw, and again and again for a minute: as soon as each
// has run for 200 ms, the next one has 300 ms to begin.
#include <random>

#include "programs/godwit-drill/flights/disturbed_flight.hpp"

namespace godwit::drill {
namespace {

constexpr std::uint64_t moments = 500; // of all vehicles together
constexpr double storm_s = 60;
constexpr double lives_s = 0.2;

flight_case killed_at_moment(sim::personality who, std::uint64_t seed, double flown_s) {
  const auto group = row_of(who, "moments");
  const auto name = group + "/" + std::to_string(seed);
  return {name, group, [=](const flight_wishes& wishes) {
            watched_flight watched({.who = who, .seed = seed}, wishes, name, group);
            std::mt19937_64 drawn(seed);
            watched.flight().run_for(flown_s * std::uniform_real_distribution<double>(0, 1)(drawn));
            if (executor::is_at_rest(watched.flight().status().now)) // in another order of events it is shorter
              watched.so_far().skipped = "the flight is over by then";
            watched.flight().kill_process();
            return watched.finish();
          }};
}

// The guard keeps the process from beginning behind a hundred ends on the ground; then a person takes its file away.
std::string storm(watched_flight& watched) {
  auto& flight = watched.flight();
  const auto end_ns = flight.now_ns() + static_cast<std::int64_t>(storm_s * 1e9);
  while (flight.now_ns() < end_ns) {
    if (!flight.run_until([&] { return flight.process() != nullptr; }, 1))
      continue;
    flight.run_for(lives_s);
    flight.kill_process();
  }
  flight.forget_abnormal_ends();
  return {};
}

} // namespace

std::vector<flight_case> kill_cases(vehicles which, std::span<const double> flown_s) {
  std::vector<flight_case> result;
  for (std::size_t i = 0; i < which.size(); ++i) {
    const auto who = which[i];
    for (std::uint64_t seed = 1; seed <= moments / which.size(); ++seed)
      result.push_back(killed_at_moment(who, seed, flown_s[i]));
    for (const auto part : flight_parts)
      result.push_back(case_of(
          {.wanted = slow_flight(who), .part = part, .what = "killed_each_200ms", .row = "storms", .disturb = storm}));
  }
  return result;
}

} // namespace godwit::drill
