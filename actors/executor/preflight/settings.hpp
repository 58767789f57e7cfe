// What can be set about the preflight checks. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::executor::preflight {

struct settings {
  std::int32_t battery_return_percent = 25;     // at which the failsafe returns: the same as in its settings
  std::int32_t battery_critical_percent = 15;   // at which it lands: the same as in its settings
  bool starts_by_itself = false;                // flights begin without anybody who could acknowledge
  std::int32_t battery_margin_percent = 15;     // above that, so that a flight does not end as it begins
  std::int32_t min_satellites = 6;              // PX4 asks for as many (EKF2_REQ_NSATS)
  std::int64_t position_stale_ms = 2'000;       // at 1 Hz, the slowest that is usual, one may be late
  std::int64_t journal_min_free_mib = 64;       // nothing is flown with less: a full disk stops all progress
  std::int64_t journal_low_free_mib = 512;      // a full trace (256 MiB), and as much again for everything else
  std::int64_t earliest_date_s = 1'735'689'600; // 2025-01-01, UTC: a clock before it was never set
  bool is_operator_session_required = false;
  std::string open_line = {};            // to the vehicle, over a network and without a key; empty: it is not
  bool asks_for_straight_return = false; // through an exclusion fence: else it is said, and flown all the same

  GODWIT_FIELDS(settings, "executor.preflight_settings", battery_return_percent, battery_critical_percent,
                starts_by_itself, open_line, battery_margin_percent, min_satellites, position_stale_ms,
                journal_min_free_mib, journal_low_free_mib, earliest_date_s, is_operator_session_required,
                asks_for_straight_return);
  friend bool operator==(const settings&, const settings&) = default;
};

} // namespace godwit::executor::preflight
