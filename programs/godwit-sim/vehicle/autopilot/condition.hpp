// How the autopilot is: what a HEARTBEAT tells and what follows from it. Thread: values.
#pragma once

#include <cstdint>

#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"

namespace godwit::sim {

struct condition {
  const flight_mode* mode = nullptr;
  const flight_mode* intended = nullptr; // by people; a failsafe of its own changes MODE alone
  bool is_armed = false;
  bool has_position = true;    // from satellites
  bool is_ready = true;        // has been up for as long as it needs before it flies
  bool has_estimate = true;    // its estimator knows where it is: some time after a start, and while it has a position
  bool is_plan_armable = true; // by its own checks
  bool is_battery_empty = false;
  bool is_home_fixed = false;        // by a command: arming moves it no longer
  bool beats_at_mode_change = false; // a HEARTBEAT at once, besides those of each second
  std::int64_t started_world_ns = 0; // its own clock is 0 then

  [[nodiscard]] bool is_in(mode_kind kind) const { return mode->kind == kind; }
  [[nodiscard]] std::int64_t up_ns(std::int64_t world_ns) const { return world_ns - started_world_ns; }
};

} // namespace godwit::sim
