// Who runs, and what follows when a child can not be kept up: a child x the part of the flight.
//
//   child                    ground      flight      after
//   vehicle_link             essential   essential   essential
//   failsafe, executor       essential   essential   essential
//   ground_port              wanted      wanted      wanted
//   operator_bridge          wanted      wanted      wanted
//   landing_watch            wanted      wanted      wanted: it ends a process whose executor is given up
//   mission_client           wanted      wanted *    essential: it delivers what is owed
//   scan_controller          -           scans *     -            only while a mission with scanning is flown
//   movement_detector        -           scans *     -            the same
//   ground_run               essential   -           -            a run on the ground is supervised by the first column
//   others                   wanted      wanted *    wanted       * not in a reduced process
//   health, telemetry_stream, fleet_link   the same; no flight waits for them: they only show
//
// An essential child that is given up ends the process: on the ground in order; in flight fast, and once within ten
// minutes only (runtime::process_end::fast_once). When that is used up the rest goes on, and vehicle_link is restarted
// for ever. The part comes from the durable state, not from names of phases. Pure. Thread: plain values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "actors/executor/supervision/child_name.hpp"
#include "actors/executor/supervision/part.hpp"
#include "io/fields/field_table.hpp"
#include "runtime/supervision/messages.hpp"

namespace godwit::executor::supervision {

// Of this process; see crash_loop_guard.
struct circumstances {
  bool may_end_fast = true; // no process before it has ended fast within ten minutes
  bool is_reduced = false;  // too many ended abnormally in flight: only what flies runs
  GODWIT_FIELDS(circumstances, "executor.circumstances", may_end_fast, is_reduced);
};

// What an incarnation of the executor is told of its process.
struct own_process {
  circumstances how;
  std::vector<std::string> children; // in start order
  GODWIT_FIELDS(own_process, "executor.own_process", how, children);
};

// Of CHILDREN, in their order. One that the table does not name is wanted and not essential. SCANS: what is flown is a
// mission with scanning.
[[nodiscard]] std::vector<runtime::child_entry> table_of(part now, const circumstances& process,
                                                         const std::vector<std::string>& children, bool scans);

// With which a child is added: that of the ground, until a table holds.
[[nodiscard]] runtime::child_policy policy_of(child_name child);

[[nodiscard]] bool is_wanted_on_ground(std::string_view child);

// Nothing of a flight depends on it: it may be down, or given up, and preflight passes.
[[nodiscard]] bool is_dispensable(std::string_view child);

// What no table can have stopped.
[[nodiscard]] std::vector<std::string> floor_children();

} // namespace godwit::executor::supervision
