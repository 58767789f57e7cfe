// What drives the state of the preflight checks. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "actors/executor/preflight/report.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::executor::preflight {

// A flight of this mission is prepared. Said again while the checks are under way or passed, it changes nothing; after
// a failure it wants a new look. An empty id and revision 0 while no mission is loaded.
struct checks_wanted {
  std::string mission_id;
  std::int32_t revision = 0;
  GODWIT_FIELDS(checks_wanted, "executor.preflight_checks_wanted", mission_id, revision);
};

// The checks were run: each second from checks_wanted to the take-off, and once more just before a start.
struct looked {
  report what;
  GODWIT_FIELDS(looked, "executor.preflight_looked", what);
};

// An authenticated operator has read the report with this number, and wants to fly all the same.
struct acknowledged {
  std::uint32_t report_id = 0;
  std::string by; // who it is, by the means that authenticated the session
  GODWIT_FIELDS(acknowledged, "executor.preflight_acknowledged", report_id, by);
};

// The mission in memory is another one, or another revision of it.
struct mission_changed {
  std::string mission_id;
  std::int32_t revision = 0;
  GODWIT_FIELDS(mission_changed, "executor.preflight_mission_changed", mission_id, revision);
};

// It is in the air; a rover: it moves.
struct took_off {
  static constexpr auto fields = io::table("executor.preflight_took_off");
};

// It stands and is disarmed, or was given up.
struct flight_ended {
  static constexpr auto fields = io::table("executor.preflight_flight_ended");
};

// This process or actor began anew: what was true of the vehicle may not be so any more.
struct restarted {
  static constexpr auto fields = io::table("executor.preflight_restarted");
};

using event = std::variant<checks_wanted, looked, acknowledged, mission_changed, took_off, flight_ended, restarted>;

} // namespace godwit::executor::preflight
