// How far the preflight checks of a flight are: what must survive a crash. Nanoseconds since 1970 (UTC). Thread: plain
// values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::executor::preflight {

enum class phase {
  idle,         // no flight is prepared
  running,      // a look is awaited
  pass,         // it may start, or has started
  awaiting_ack, // of the report with this number
  failed        // it may not start
};

GODWIT_ENUM_NAMES(phase, idle, running, pass, awaiting_ack, failed);

// What operators are asked to acknowledge, or have acknowledged. It holds for this flight.
struct open_report {
  std::uint32_t id = 0;
  std::vector<std::string> sentences; // of what was degraded
  std::int64_t opened_ns = 0;
  std::string acknowledged_by; // empty: nobody has yet
  GODWIT_FIELDS(open_report, "executor.preflight_open_report", id, sentences, opened_ns, acknowledged_by);
};

inline constexpr std::size_t max_known_open_lines = 8; // the oldest is forgotten, and asked about again
inline constexpr std::size_t max_operator_name = 64;   // bytes; the rest is cut off

struct state {
  phase now = phase::idle;
  std::string mission_id; // of the flight that is prepared
  std::int32_t revision = 0;
  bool is_flying = false;            // with the pass that it has; nothing that is seen now changes it
  std::uint32_t last_report_id = 0;  // of any flight: a late acknowledgement never meets another report
  std::optional<open_report> report; // when failed: it was not acknowledged in time
  std::string reason;                // why failed, or idle again
  // Sentences about lines without a key that somebody has acknowledged, of any flight; the newest last.
  std::vector<std::string> known_open_lines = {};

  static constexpr int version = 1;
  GODWIT_FIELDS(state, "executor.preflight_state", now, mission_id, revision, is_flying, last_report_id, report, reason,
                known_open_lines);
};

} // namespace godwit::executor::preflight
