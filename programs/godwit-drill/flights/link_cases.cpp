// The links of a flight fail: the vehicle's, the ground station's and that to the missions service are cut in each part
// of a flight, the autopilot starts again, somebody else speaks on the vehicle's line, and the line is bad throughout.
#include <array>
#include <chrono>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/forged_frames.hpp"
#include "programs/godwit-drill/flights/disturbed_flight.hpp"

namespace godwit::drill {
namespace {

using executor::phase;

// -- cuts -------------------------------------------------------------------------------------------

enum class link { vehicle, station, service };

struct named_link {
  link which;
  const char* name;
};
constexpr std::array links{named_link{link::vehicle, "vehicle"}, named_link{link::station, "station"},
                           named_link{link::service, "service"}};
constexpr std::array cuts_s{1, 10, 60};
constexpr int station_is_lost_after_s = 30; // from then on the failsafe brings the vehicle home

void cut(flight_simulation& flight, link which, double seconds) {
  switch (which) {
  case link::vehicle:
    return flight.cut_line(seconds);
  case link::station:
    return flight.cut_station(seconds);
  case link::service:
    return flight.cut_service(seconds);
  }
}

disturbed_flight cut_flight(sim::personality who, phase part, named_link which, int seconds) {
  disturbed_flight result{.wanted = slow_flight(who), .part = part};
  result.what = std::string(which.name) + "_cut_" + std::to_string(seconds) + "s";
  if (which.which == link::station && seconds > station_is_lost_after_s)
    result.end = flight_end::or_waits;
  result.disturb = [which, seconds](watched_flight& watched) {
    cut(watched.flight(), which.which, seconds);
    watched.flight().run_for(seconds);
    return std::string();
  };
  return result;
}

// -- the autopilot starts again ---------------------------------------------------------------------

// After it nothing is commanded to a vehicle that was under way, until a person says so.
std::string reboot(watched_flight& watched) {
  constexpr double seen_within_s = 20; // it is silent for some seconds
  constexpr double left_alone_s = 10;
  auto& flight = watched.flight();
  const bool was_under_way = flight.status().in_flight;
  const auto began_ns = flight.now_ns();
  flight.reboot_vehicle();
  if (!was_under_way) {
    flight.run_for(seen_within_s);
    return {};
  }
  const auto is_left = [&] {
    const auto now = flight.status().now;
    return now == phase::paused || executor::is_over(now);
  };
  if (!flight.run_until(is_left, seen_within_s)) {
    watched.expect("godwit has not seen that the autopilot has started again");
    return {};
  }
  watched.note_recovery_since(began_ns);
  const auto since_ns = flight.now_ns();
  flight.run_for(left_alone_s);
  watched.expect(moves_since(flight, since_ns) == 0 ? ""
                                                    : "an autopilot that has started again in flight was commanded");
  return {};
}

// -- a stranger -------------------------------------------------------------------------------------

constexpr io::mavlink::sender autopilot{1, 1};
constexpr int forged_frames = 3;

void forge(flight_simulation& flight, const std::string& what) {
  using line = flight_simulation::target_line;
  for (std::uint32_t i = 1; i <= forged_frames; ++i) {
    if (what == "pilot")
      flight.forge(line::vehicle, piloted(flight.who()), autopilot);
    else if (what == "restart")
      flight.forge(line::vehicle, just_started(i), autopilot);
    else if (what == "outside")
      flight.forge(line::vehicle, far_away(), autopilot);
    flight.run_for(0.4);
  }
}
constexpr std::array lies{"pilot", "restart", "outside"};

disturbed_flight flight_with_stranger(sim::personality who, phase part, const std::string& lie) {
  disturbed_flight result{.wanted = {.who = who}, .part = part, .what = "stranger_" + lie};
  result.disturb = [lie](watched_flight& watched) {
    auto& flight = watched.flight();
    forge(flight, lie);
    flight.run_for(2);
    watched.expect(flight.was_told("paused") ? "a stranger's frames have paused the flight" : "");
    return std::string();
  };
  return result;
}

// -- a bad line -------------------------------------------------------------------------------------

struct bad_line {
  const char* name;
  sim::line_settings each_way;
};
constexpr std::uint64_t bad_line_seeds = 5;

std::array<bad_line, 3> bad_lines() {
  return {{{"loss_20_percent", {.loss = 0.2}},
           {"doubled_20_percent", {.duplication = 0.2}},
           {"late_5_percent", {.duplication = 0.05, .reorder = 0.1, .late = 0.05}}}};
}

flight_case flight_on(sim::personality who, const bad_line& line, std::uint64_t seed) {
  const auto group = row_of(who, "throughout");
  const auto name = group + "/" + line.name + "/" + std::to_string(seed);
  return {name, group, [=](const flight_wishes& wishes) {
            auto wanted = slow_flight(who);
            wanted.seed = seed;
            wanted.line = {line.each_way, line.each_way};
            return watched_flight(wanted, wishes, name, group).finish_or_wait();
          }};
}

} // namespace

std::vector<flight_case> link_cases(vehicles which) {
  std::vector<flight_case> result;
  for (const auto who : which) {
    for (const auto part : flight_parts) {
      for (const auto& each : links)
        for (const auto seconds : cuts_s)
          result.push_back(case_of(cut_flight(who, part, each, seconds)));
      result.push_back(case_of({.wanted = slow_flight(who),
                                .part = part,
                                .what = "autopilot_restart",
                                .end = flight_end::or_waits,
                                .disturb = reboot}));
      for (const auto* lie : lies)
        result.push_back(case_of(flight_with_stranger(who, part, lie)));
    }
    for (const auto& line : bad_lines())
      for (std::uint64_t seed = 1; seed <= bad_line_seeds; ++seed)
        result.push_back(flight_on(who, line, seed));
  }
  return result;
}

} // namespace godwit::drill
