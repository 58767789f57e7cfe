// How one flight of a drill went. It crosses from the process that flew it to the one that counts as JSON. Thread:
// values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::drill {

struct flight_outcome {
  std::string name;                  // of the case; given again with --only or --seeds it flies the same flight
  std::string group;                 // row of the table that it counts in
  std::string again;                 // the command that flies it again; of one with a flaw
  std::vector<std::string> flaws;    // sentences; empty: all that was promised held
  std::vector<std::string> known;    // flaws that are entered in docs/roadmap.md (known_findings.hpp)
  std::string skipped;               // why there was nothing to try; empty: it was tried
  std::uint64_t faults = 0;          // of a random flight: those that its seed has drawn
  std::uint64_t lost = 0;            // reports
  std::uint64_t doubled = 0;         // reports
  std::uint64_t kills = 0;           // of the process
  std::uint64_t crashes = 0;         // of actors, planned ones
  std::uint64_t takeovers = 0;       // that godwit has seen
  std::uint64_t commits = 0;         // of the journal
  std::uint64_t deliveries = 0;      // to actors
  std::optional<double> recovery_ms; // longest of the flight; virtual time
  double flown_s = 0;                // virtual time
  double took_s = 0;                 // of this machine
  std::string story;                 // what happened; of a flight with a flaw, or of all when it was asked for
  GODWIT_FIELDS(flight_outcome, "drill.flight_outcome", name, group, again, flaws, known, skipped, faults, lost,
                doubled, kills, crashes, takeovers, commits, deliveries, recovery_ms, flown_s, took_s, story);

  [[nodiscard]] bool held() const { return flaws.empty(); }
};

} // namespace godwit::drill
