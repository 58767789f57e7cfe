// The altitudes between which a fence counts, or a vehicle flies: metres above the place of take-off. Both ends belong
// to it. Thread: plain value.
#pragma once

#include <limits>

namespace godwit::geofence {

inline constexpr double endless_m = std::numeric_limits<double>::infinity();

struct altitude_band {
  double lowest_m = -endless_m;
  double highest_m = endless_m;

  [[nodiscard]] bool contains(double altitude_m) const { return altitude_m >= lowest_m && altitude_m <= highest_m; }
  // Whether it has a part in OTHER, or has all of it.
  [[nodiscard]] bool meets(const altitude_band& other) const {
    return lowest_m <= other.highest_m && highest_m >= other.lowest_m;
  }
  [[nodiscard]] bool has_all_of(const altitude_band& other) const {
    return lowest_m <= other.lowest_m && highest_m >= other.highest_m;
  }
};

// Every band has all of this one: for who asks for the place alone.
inline constexpr altitude_band no_altitudes{endless_m, -endless_m};

} // namespace godwit::geofence
