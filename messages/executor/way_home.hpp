// What the way home would take of the battery now, for people; nothing is flown because of it. Told with each word of
// the vehicle about its battery, so that who shows it knows how old it is. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::executor {

// Straight home at the autopilot's usual speeds without wind, by the drain that was measured or set: an estimate.
struct way_home_estimate {
  std::optional<double> needs_percent;      // of a full battery; none: not known, and `why_not_known` says why
  std::optional<std::int32_t> left_percent; // in the battery; none: the vehicle does not tell
  std::int32_t reserve_percent = 0;         // at which the failsafe returns
  std::optional<double> spare_percent;      // left above the reserve and the way home; 0 or less: it lasts just for it
  std::string why_not_known;                // sentence for people; empty when it is known
  GODWIT_FIELDS(way_home_estimate, "executor.way_home_estimate", needs_percent, left_percent, reserve_percent,
                spare_percent, why_not_known);
  friend bool operator==(const way_home_estimate&, const way_home_estimate&) = default;
};

} // namespace godwit::executor
