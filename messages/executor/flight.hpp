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
  static constexpr auto fields = io::table(
      "executor.flight_status", io::field("phase", &flight_status::phase), io::field("cause", &flight_status::cause),
      io::field("sentence", &flight_status::sentence), io::field("in_flight", &flight_status::in_flight),
      io::field("mission_id", &flight_status::mission_id), io::field("revision", &flight_status::revision),
      io::field("generation", &flight_status::generation), io::field("reports", &flight_status::reports),
      io::field("items_done", &flight_status::items_done), io::field("items", &flight_status::items),
      io::field("preflight_report", &flight_status::preflight_report), io::field("is_armed", &flight_status::is_armed),
      io::field("mode", &flight_status::mode), io::field("authority", &flight_status::authority),
      io::field("state", &flight_status::state));
  friend bool operator==(const flight_status&, const flight_status&) = default;
};

// To itself: something may be due.
struct tick {
  std::uint64_t incarnation = 0; // that goes on with it; those before have no time to keep any more
  static constexpr auto fields = io::table("executor.tick", io::field("incarnation", &tick::incarnation));
};

} // namespace godwit::executor
