// Through which exclusion fences a failsafe's return would lead: the autopilot flies it straight home from wherever it
// is, and knows no fences of ours.
//
// From a leg the straight ways home fill a triangle; an exclusion fence that has a part in it lies in the way from
// somewhere on that leg. All altitudes of the leg count, and those up to the altitude to which the vehicle climbs
// first. A rover keeps to all fences whatever their altitudes. Home is where a plan begins: a vehicle that is armed
// there sets it so. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "actors/executor/plan/flight_plan.hpp"
#include "actors/executor/plan/setting.hpp"
#include "messages/mission/document.hpp"

namespace godwit::executor::plan {

struct return_crossing {
  std::uint32_t item_index = 0; // in the mission: on the way to it, or at it
  std::size_t fence = 0;        // its place in the mission
  friend bool operator==(const return_crossing&, const return_crossing&) = default;
};

// In the order of the way, each pair once. Empty: none, or fences that nobody can judge, which fence_violations tells.
[[nodiscard]] std::vector<return_crossing>
straight_return_crossings(const flight_plan& plan, const mission::document& mission, const plan_setting& setting);

} // namespace godwit::executor::plan
