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
  static constexpr auto fields = io::table(
      "drill.flight_outcome", io::field("name", &flight_outcome::name), io::field("group", &flight_outcome::group),
      io::field("again", &flight_outcome::again), io::field("flaws", &flight_outcome::flaws),
      io::field("known", &flight_outcome::known), io::field("skipped", &flight_outcome::skipped),
      io::field("faults", &flight_outcome::faults), io::field("lost", &flight_outcome::lost),
      io::field("doubled", &flight_outcome::doubled), io::field("kills", &flight_outcome::kills),
      io::field("crashes", &flight_outcome::crashes), io::field("takeovers", &flight_outcome::takeovers),
      io::field("commits", &flight_outcome::commits), io::field("deliveries", &flight_outcome::deliveries),
      io::field("recovery_ms", &flight_outcome::recovery_ms), io::field("flown_s", &flight_outcome::flown_s),
      io::field("took_s", &flight_outcome::took_s), io::field("story", &flight_outcome::story));

  [[nodiscard]] bool held() const { return flaws.empty(); }
};

} // namespace godwit::drill
