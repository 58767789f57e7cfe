// One look at everything: what each check found, and the worst of it. Thread: plain values, pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "actors/executor/preflight/facts.hpp"
#include "actors/executor/preflight/result.hpp"
#include "actors/executor/preflight/settings.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::executor::preflight {

struct finding {
  std::string check; // its name in the table of checks.hpp
  verdict how = verdict::fail;
  std::string sentence;
  GODWIT_FIELDS(finding, "executor.preflight_finding", check, how, sentence);
  friend bool operator==(const finding&, const finding&) = default;
};

struct report {
  std::uint32_t id = 0;            // what an acknowledgement names; 0: none is asked for
  std::string mission_id;          // empty: no mission was loaded
  std::int32_t revision = 0;       // 0: the same
  verdict overall = verdict::fail; // a report of nothing is no pass
  std::vector<finding> findings;   // one for each check, in the order of the table
  GODWIT_FIELDS(report, "executor.preflight_report", id, mission_id, revision, overall, findings);
  friend bool operator==(const report&, const report&) = default;
};

// As it was found at that time: nanoseconds since 1970 (UTC).
struct dated_report {
  report what;
  std::int64_t at_ns = 0;
};

[[nodiscard]] report run_checks(const facts& seen, const settings& set);

// The worst; of nothing, fail.
[[nodiscard]] verdict worst_of(const std::vector<finding>& all);

// Of all findings with this verdict, in their order.
[[nodiscard]] std::vector<std::string> sentences_of(const report& what, verdict how);

} // namespace godwit::executor::preflight
