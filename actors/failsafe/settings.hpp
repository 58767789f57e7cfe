// What can be set about the failsafes. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::failsafe {

// Whose silence counts. A ground station is heard by its heartbeats.
enum class operator_link_policy {
  off,       // nobody has to be there
  once_seen, // who was never heard is never lost
  required   // somebody has to be there from the start
};

GODWIT_ENUM_NAMES(operator_link_policy, off, once_seen, required);

struct settings {
  operator_link_policy operator_link = operator_link_policy::once_seen;
  bool failsafe_in_manual = false;            // false: while a pilot has the vehicle, failsafes only warn
  std::int32_t battery_critical_percent = 15; // and below
  std::int32_t battery_low_percent = 25;      // and below
  std::int64_t link_degraded_ms = 5'000;      // of silence: warn, fly on
  std::int64_t link_lost_ms = 30'000;         // of silence: return
  std::int64_t following_extra_ms = 30'000;   // more of it while an object is followed
  double moving_mps = 0.2;                    // a rover that is faster moves; a standing one drifts by less than this

  GODWIT_FIELDS(settings, "failsafe.settings", operator_link, failsafe_in_manual, battery_critical_percent,
                battery_low_percent, link_degraded_ms, link_lost_ms, following_extra_ms, moving_mps);
  friend bool operator==(const settings&, const settings&) = default;
};

// What is wrong with it, as a sentence that names the key. Nothing: it can be used.
[[nodiscard]] std::optional<std::string> objection_to(const settings& configured);

} // namespace godwit::failsafe
