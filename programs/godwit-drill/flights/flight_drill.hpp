// Flies all cases of one drill and says what came of them. Thread: one, and no other in the process.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"
#include "programs/godwit-drill/flight_simulation/people_audit.hpp"
#include "programs/godwit-sim/vehicle/personality.hpp"

namespace godwit::drill {

enum class flight_drill { simulate, interventions, starts, actors, process, disk, links, people, clock };

GODWIT_ENUM_NAMES(flight_drill, simulate, interventions, starts, actors, process, disk, links, people, clock);

struct seed_range {
  std::uint64_t first = 1;
  std::uint64_t last = 100; // flown, too
};

// Its flights are drawn from seeds; those of the others are enumerated.
[[nodiscard]] constexpr bool is_by_seed(flight_drill which) {
  return which == flight_drill::simulate || which == flight_drill::interventions || which == flight_drill::starts;
}

// "A..B" or "A". Nothing: it is neither, or A is after B.
[[nodiscard]] std::optional<seed_range> seed_range_from(const std::string& text);

// One of the machines that share a range of seeds.
struct shard {
  std::uint64_t number = 1; // from 1 on
  std::uint64_t of = 1;
};

// "I/N", with I from 1 to N. Nothing: it is not.
[[nodiscard]] std::optional<shard> shard_from(const std::string& text);

// The seeds of its machine: N parts that follow each other, of which none is more than one seed longer. Nothing: there
// are fewer seeds than machines before this one.
[[nodiscard]] std::optional<seed_range> part_of(const seed_range& all, const shard& which);

struct flight_drill_options {
  flight_drill which = flight_drill::simulate;
  seed_range seeds;                    // of a drill by seed
  drill::shard shard;                  // of these: the part that is flown
  std::vector<std::uint64_t> without;  // of a drill by seed: faults that no flight has
  std::optional<sim::personality> who; // else all that the drill knows
  std::string only;                    // name of the one case that is flown, and its story told
  std::optional<std::uint64_t> sample; // so many of the cases, drawn by sample_seed; else all
  std::uint64_t sample_seed = 1;
  std::optional<double> stream_hz; // of simulate: positions a second
  unsigned jobs = 1;
  planted_flaw planted = planted_flaw::none;
  std::string json_file; // empty: none
  std::string html_file; // empty: none
  std::string
      trace_folder; // of the one flight, or with a folder for each that fails; empty: one is made when it is needed
};

// Says it on stdout, and on stderr how far it is. The exit code: 0, 1 (a flight has a flaw, or the file can not be
// written) or 2 (there is no such case).
[[nodiscard]] int run_flight_drill(const flight_drill_options& options);

// Finds the fewest faults with which a failing random flight still fails. Thread: pure; FAILS flies.

// Which of FAULTS (0 to FAULTS - 1) can be left out: none of the others can be left out alone. FAILS is asked at most
// FAULTS * FAULTS times, with those that are left out.
[[nodiscard]] std::vector<std::uint64_t>
not_needed_to_fail(std::uint64_t faults, const std::function<bool(const std::vector<std::uint64_t>& without)>& fails);

} // namespace godwit::drill
