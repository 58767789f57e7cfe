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
  std::string state; // another one whenever what a person decides by has changed: what a command can be meant for
  GODWIT_FIELDS(flight_status, "executor.flight_status", phase, cause, sentence, in_flight, mission_id, revision,
                generation, reports, items_done, items, preflight_report, is_armed, mode, authority, state);
  friend bool operator==(const flight_status&, const flight_status&) = default;
};

// To itself: something may be due.
struct tick {
  std::uint64_t incarnation = 0; // that goes on with it; those before have no time to keep any more
  GODWIT_FIELDS(tick, "executor.tick", incarnation);
};

} // namespace godwit::executor
