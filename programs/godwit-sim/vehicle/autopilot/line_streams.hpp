// What the autopilot sends by itself on one line: its streams and MISSION_CURRENT, each as often as was asked for on
// that line. World time. Thread: one at a time.
#pragma once

#include <algorithm>
#include <cstdint>

#include "actors/ground_port/vehicle_role/current_report.hpp"
#include "actors/ground_port/vehicle_role/message_schedule.hpp"
#include "programs/godwit-sim/vehicle/autopilot/names.hpp"

namespace godwit::sim {

struct line_streams {
  role::message_schedule messages;
  role::current_report current;

  [[nodiscard]] std::int64_t next_due_ns() const { return std::min(messages.next_due_ns(), current.next_due_ns()); }
};

} // namespace godwit::sim
