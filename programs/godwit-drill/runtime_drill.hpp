// The runtime drill: a million messages through supervised actors while they are crashed a thousand times, then the
// count.
//
//   source ──> relay 1..4 ──> ledger 1..4 ──> auditor        every tenth message: a row in drill_effect and a durable
//   receipt
//
// Crashes come evenly over the run, at an actor and a point drawn from the seed: before the handler, after it, after
// the commit, before an effect goes out; and between two messages (a kill). Some messages crash every handler and must
// end as dead letters. What is counted is told by the audit (outside the actors) and by the journal's tables; `sent =
// handled + dead_lettered + lost`. Thread: run_runtime_drill blocks; one at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "runtime/process.hpp"

namespace godwit::drill {

struct runtime_drill_options {
  std::uint64_t messages = 1'000'000;
  std::uint64_t crashes = 1'000;
  std::uint64_t seed = 1;
  runtime::process_options process; // journal and trace: where they go
};

struct runtime_drill_result {
  std::uint64_t sent = 0;
  std::uint64_t handled = 0;
  std::uint64_t dead_lettered = 0;
  std::uint64_t lost = 0;             // neither handled nor a dead letter
  std::uint64_t doubled = 0;          // handled again, or more than one row in drill_effect
  std::uint64_t effects_expected = 0; // durable messages handled
  std::uint64_t effects_found = 0;    // rows in drill_effect
  std::uint64_t crashes = 0;
  std::uint64_t restarts = 0;
  double restart_p50_us = 0;
  double restart_p99_us = 0;
  double restart_max_us = 0;
  std::uint64_t trace_records = 0;
  std::uint64_t trace_dropped = 0;
  std::uint64_t journal_commits = 0;
  double seconds = 0;

  [[nodiscard]] bool passed() const { return lost == 0 && doubled == 0 && effects_expected == effects_found; }
};

// The error is a sentence for people.
[[nodiscard]] tl::expected<runtime_drill_result, std::string> run_runtime_drill(runtime_drill_options options);

[[nodiscard]] nlohmann::json to_json(const runtime_drill_result& result, std::uint64_t seed);

} // namespace godwit::drill
