// Whether the way of a plan keeps to the fences of its mission: its legs and not only their ends, and its altitudes.
//
// With inclusion fences, each leg lies inside of them (inside of several together, where they overlap); no leg comes
// into an exclusion fence. A side belongs to the inside of both kinds, to a millimetre. A fence with floor or ceiling
// is a block of air: an inclusion must reach over all altitudes of a leg, and an exclusion matters if it has a part in
// them; vehicles climb differently between two places, so all altitudes from one to the other count on the whole leg.
// Climbing from the ground and landing are not held against floors. A rover keeps to all fences whatever their
// altitudes.
//
// The geometry is that of the failsafe (actors/domain/geofence). Fences that are none give one violation. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/executor/plan/flight_plan.hpp"
#include "actors/executor/plan/setting.hpp"
#include "messages/mission/document.hpp"

namespace godwit::executor::plan {

inline constexpr std::size_t max_violations = 32; // of one plan: more than anyone reads

enum class violation_kind { outside_inclusion, inside_exclusion, below_floor, above_ceiling };

GODWIT_ENUM_NAMES(violation_kind, outside_inclusion, inside_exclusion, below_floor, above_ceiling);

struct violation {
  violation_kind kind{};
  std::optional<std::size_t> fence;        // its place in the mission; absent: outside of all inclusions
  std::optional<std::size_t> leg;          // its place in the plan; absent: the return point
  std::optional<std::uint32_t> item_index; // in the mission, for which the leg is flown
  std::string message;                     // "The way to item 'w2' leaves geofence 1, which it has to stay in."
};

// In the order of the way; empty: it keeps to the fences.
[[nodiscard]] std::vector<violation> fence_violations(const flight_plan& plan, const mission::document& mission,
                                                      vehicle_class vehicle);

// The same for the return point, if there is one, whatever the altitude: it lies in an inclusion if there are any, and
// in no exclusion.
[[nodiscard]] std::vector<violation> return_point_violations(const mission::document& mission);

} // namespace godwit::executor::plan
