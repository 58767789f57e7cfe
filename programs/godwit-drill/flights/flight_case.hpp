// One of the enumerated flights of a drill. Thread: values; fly() in one.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "programs/godwit-drill/flights/flight_outcome.hpp"
#include "programs/godwit-drill/flights/watched_flight.hpp"

namespace godwit::drill {

struct flight_case {
  std::string name;  // parts with slashes between them, the vehicle first; unique in its drill
  std::string group; // row of the table
  std::function<flight_outcome(const flight_wishes& wishes)> fly;
};

using vehicles = std::span<const sim::personality>;

// "px4/flying": a group of cases of this vehicle.
[[nodiscard]] inline std::string row_of(sim::personality who, std::string_view row) {
  return std::string(io::name_of(who)) + "/" + std::string(row);
}

// Each actor throws once at each crash point in each part of a flight.
[[nodiscard]] std::vector<flight_case> actor_cases(vehicles which);

// Two actors end at once, an actor ends at each start until it is given up, and one hangs, in each part of a flight.
[[nodiscard]] std::vector<flight_case> actor_loss_cases(vehicles which);

// scan_controller throws, ends, or ends with others, around each sighting and each decision in a survey. Not of planes.
[[nodiscard]] std::vector<flight_case> scan_cases(vehicles which);

// The process is killed before and after each commit of a whole flight. COMMITS: of such a flight, by vehicle.
[[nodiscard]] std::vector<flight_case> process_cases(vehicles which, std::span<const std::uint64_t> commits);
// It is killed at moments of a flight that their seeds draw, and again and again for a minute.
// FLOWN_S: of a whole flight, by vehicle.
[[nodiscard]] std::vector<flight_case> kill_cases(vehicles which, std::span<const double> flown_s);
// A flight without a fault, whose outcome says how many commits there are, and how long it takes.
[[nodiscard]] flight_outcome fly_undisturbed(sim::personality who, const flight_wishes& wishes);

// The journal's disk fails in one of several ways at each fourth commit of a flight.
[[nodiscard]] std::vector<flight_case> disk_cases(vehicles which, std::span<const std::uint64_t> commits);

// The journal is a file, and its disk fails below SQLite at each fourth commit of a flight.
[[nodiscard]] std::vector<flight_case> stored_disk_cases(vehicles which, std::span<const std::uint64_t> commits);

// Lines and services are cut, are bad throughout, or have a stranger on them; the autopilot starts again.
[[nodiscard]] std::vector<flight_case> link_cases(vehicles which);

// The wall clock is set, and the process is suspended.
[[nodiscard]] std::vector<flight_case> clock_cases(vehicles which);

// A person takes the vehicle by each of its modes in each part of a flight.
[[nodiscard]] std::vector<flight_case> people_cases(vehicles which);
// At each item, twice, while godwitd is dead; and operators who contradict each other.
[[nodiscard]] std::vector<flight_case> takeover_cases(vehicles which);

// The actors of a flight, by their names in godwitd. Thread: constants.
inline constexpr std::array actor_names{"vehicle_link",   "failsafe", "mapobjects_store",
                                        "mission_client", "executor", "ground_port"};

} // namespace godwit::drill
