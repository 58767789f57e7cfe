// What became of the sightings of a run. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::daemon {

struct sighting_counts {
  std::uint64_t recorded = 0;    // answered by the map store, those that it had already included
  std::uint64_t refused = 0;     // by the map store, or for want of room
  std::uint64_t unreadable = 0;  // lines that are no sightings
  std::uint64_t not_offered = 0; // recorded, and scan_controller did not answer
  GODWIT_FIELDS(sighting_counts, "godwitd.sighting_counts", recorded, refused, unreadable, not_offered);
};

} // namespace godwit::daemon
