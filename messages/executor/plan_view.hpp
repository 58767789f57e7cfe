// What people look at before and during a flight: the plan as it is flown, and what the preflight checks have found.
// Asked for by who shows it. Degrees (WGS 84), metres above the place that the mission counts from. Thread: plain
// values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/flight/home_place.hpp"
#include "messages/mission/document.hpp"
#include "messages/mission/place.hpp"

namespace godwit::executor {

struct get_plan {
  static constexpr auto fields = io::table("executor.get_plan");
};

struct plan_view {
  std::optional<mission::document> mission; // none: there is none
  std::uint32_t generation = 0;             // of the plan on the vehicle; 0: none was brought there
  std::vector<mission::position> way;       // through which that plan leads, in its order; empty: none is there
  std::optional<flight::home_place> home;   // the vehicle's own, as it tells
  std::optional<flight::home_place> kept;   // where godwit's returns lead, from the first take-off on
  GODWIT_FIELDS(plan_view, "executor.plan_view", mission, generation, way, home, kept);
};

struct get_preflight {
  static constexpr auto fields = io::table("executor.get_preflight");
};

struct preflight_finding {
  std::string check;
  std::string verdict;  // skipped, pass, degraded, fail
  std::string sentence; // what is wrong, where, and what to do
  GODWIT_FIELDS(preflight_finding, "executor.preflight_finding_view", check, verdict, sentence);
};

struct preflight_view {
  std::string phase;                       // idle, running, pass, awaiting_ack, failed
  std::string reason;                      // why failed, or idle again
  std::uint32_t report = 0;                // that waits for an acknowledgement; 0: none
  std::string acknowledged_by;             // of this flight's report; empty: nobody
  std::int64_t looked_ms = 0;              // since 1970 (UTC); 0: this incarnation has not looked yet
  std::vector<preflight_finding> findings; // of that look, in the order of the checks
  GODWIT_FIELDS(preflight_view, "executor.preflight_view", phase, reason, report, acknowledged_by, looked_ms, findings);
};

} // namespace godwit::executor
