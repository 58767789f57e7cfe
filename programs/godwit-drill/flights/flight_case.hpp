// One of the enumerated flights of a drill. Thread: values; fly() in one.
#pragma once

#include <functional>
#include <span>
#include <string>
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

// Each actor throws once at each crash point in each part of a flight.
[[nodiscard]] std::vector<flight_case> actor_cases(vehicles which);

// The process is killed before and behind each commit of a whole flight. COMMITS: of such a flight, by vehicle.
[[nodiscard]] std::vector<flight_case> process_cases(vehicles which, std::span<const std::uint64_t> commits);
// A flight without a fault, whose outcome says how many commits there are.
[[nodiscard]] flight_outcome fly_undisturbed(sim::personality who, const flight_wishes& wishes);

// A person takes the vehicle by each of its modes in each part of a flight.
[[nodiscard]] std::vector<flight_case> people_cases(vehicles which);

} // namespace godwit::drill
