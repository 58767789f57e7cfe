// Into which modes a plan leads the vehicle by itself, and where in the plan. Such a change is nobody's takeover.
// Modes are exact HEARTBEAT.custom_mode values. Thread: plain values. Source: HEARTBEAT (0), MISSION_CURRENT (42).
#pragma once

#include <cstdint>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::flight {

struct plan_end {
  std::uint16_t from_sequence = 0;  // of the last item that moves the vehicle
  bool as_it_begins = false;        // the mode changes as that item begins; else when the mission is complete
  std::vector<std::uint32_t> modes; // empty: the plan leaves the mode as it is

  GODWIT_FIELDS(plan_end, "flight.plan_end", from_sequence, as_it_begins, modes);
  friend bool operator==(const plan_end&, const plan_end&) = default;
};

} // namespace godwit::flight
