// How a flight stands, for who watches it: the control socket, ground stations, the demo. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::executor {

struct get_flight {
  static constexpr auto fields = io::table("executor.get_flight");
};

struct flight_status {
  std::string phase;    // disconnected, connected, preflight, ... as in docs/architecture.md
  std::string cause;    // of a pause; `none` else
  std::string sentence; // for people
  bool in_flight = false;
  std::string mission_id; // empty: none
  std::int32_t revision = 0;
  std::uint32_t generation = 0;
  std::uint32_t reports = 0;    // made for this mission
  std::uint32_t items_done = 0; // of the mission
  std::uint32_t items = 0;
  std::uint32_t preflight_report = 0; // that waits for an acknowledgement; 0: none
  bool is_armed = false;
  std::string mode;
  // Who has the vehicle: godwit, person, failsafe (ours), autopilot_end (its plan has ended), autopilot_failsafe (its
  // own), unclear (until the vehicle has told), pending (until it has answered a station's command), nobody (no flight
  // is watched).
  std::string authority = "nobody";
  std::string why_no_mission; // of people; empty: one is taken
  std::string state; // another one whenever what a person decides by has changed: what a command can be meant for
  GODWIT_FIELDS(flight_status, "executor.flight_status", phase, cause, sentence, in_flight, mission_id, revision,
                generation, reports, items_done, items, preflight_report, is_armed, mode, authority, why_no_mission,
                state);
  friend bool operator==(const flight_status&, const flight_status&) = default;
};

// To itself: something may be due.
struct tick {
  std::uint64_t incarnation = 0; // that goes on with it; those before have no time to keep any more
  GODWIT_FIELDS(tick, "executor.tick", incarnation);
};

// What the way home would take of the battery now, for people; nothing is flown because of it. Told with each word of
// the vehicle about its battery, so that who shows it knows how old it is. Thread: plain values.

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
