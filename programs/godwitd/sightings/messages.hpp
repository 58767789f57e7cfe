// What is said to the feeder. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "runtime/seam.hpp"

namespace godwit::daemon {

// What became of the sightings of a run. Thread: plain values.
struct sighting_counts {
  std::uint64_t recorded = 0;    // answered by the map store, those that it had already included
  std::uint64_t refused = 0;     // by the map store, or for want of room
  std::uint64_t unreadable = 0;  // lines that are no sightings
  std::uint64_t not_offered = 0; // recorded, and scan_controller did not answer
  GODWIT_FIELDS(sighting_counts, "godwitd.sighting_counts", recorded, refused, unreadable, not_offered);
};

} // namespace godwit::daemon

namespace godwit::sightings {

// The feed has sightings again, or has ended.
struct woken {
  static constexpr auto fields = io::table("sightings.woken");
};

struct tick {
  std::uint64_t incarnation = 0; // that goes on with it; those before have no time to keep any more
  GODWIT_FIELDS(tick, "sightings.tick", incarnation);
};

struct get_sightings {
  static constexpr auto fields = io::table("sightings.get_sightings");
};

using waking_handle = runtime::mailbox<runtime::tells<woken>>;
using status_handle = runtime::mailbox<runtime::asks<get_sightings, daemon::sighting_counts>>;
// A sighting says itself.
using feeder_handle =
    runtime::mailbox<runtime::tells<woken>, runtime::tells<tick>, runtime::tells<mapobjects_store::sighting>,
                     runtime::asks<get_sightings, daemon::sighting_counts>>;

} // namespace godwit::sightings
