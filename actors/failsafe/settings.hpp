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

constexpr auto enum_names(operator_link_policy) {
  return io::names<operator_link_policy>({{operator_link_policy::off, "off"},
                                          {operator_link_policy::once_seen, "once_seen"},
                                          {operator_link_policy::required, "required"}});
}

struct settings {
  operator_link_policy operator_link = operator_link_policy::once_seen;
  bool failsafe_in_manual = false;            // false: while a pilot has the vehicle, failsafes only warn
  std::int32_t battery_critical_percent = 15; // and below
  std::int32_t battery_low_percent = 25;      // and below
  std::int64_t link_degraded_ms = 5'000;      // of silence: warn, fly on
  std::int64_t link_lost_ms = 30'000;         // of silence: return
  std::int64_t following_extra_ms = 30'000;   // more of it while an object is followed
  double moving_mps = 0.2;                    // a rover that is faster moves; a standing one drifts by less than this

  static constexpr auto fields = io::table(
      "failsafe.settings", io::field("operator_link", &settings::operator_link),
      io::field("failsafe_in_manual", &settings::failsafe_in_manual),
      io::field("battery_critical_percent", &settings::battery_critical_percent),
      io::field("battery_low_percent", &settings::battery_low_percent),
      io::field("link_degraded_ms", &settings::link_degraded_ms), io::field("link_lost_ms", &settings::link_lost_ms),
      io::field("following_extra_ms", &settings::following_extra_ms), io::field("moving_mps", &settings::moving_mps));
  friend bool operator==(const settings&, const settings&) = default;
};

// What is wrong with it, as a sentence that names the key. Nothing: it can be used.
[[nodiscard]] std::optional<std::string> objection_to(const settings& configured);

} // namespace godwit::failsafe
