// The fence and the rally points of a ground station's plan; see plan_import.hpp. Thread: pure.
#pragma once

#include <optional>
#include <vector>

#include "actors/domain/mission/convert/conversion.hpp"
#include "actors/domain/mission/convert/plan_source.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {

struct imported_fences {
  std::vector<geofence> all;
  std::vector<source_place> places; // of each
  std::optional<position> breach_return_point;
};

[[nodiscard]] imported_fences import_fence(plan_source& source, const plan_node& fence);

// Nothing: there is none.
[[nodiscard]] std::optional<std::vector<position>> import_rally_points(plan_source& source, const plan_node& rally);

inline constexpr std::size_t corners_of_circle = 32; // within 0.5 % of the radius

// A polygon for a circle: within it, so that an inclusion never lets out, or around it, so that an exclusion never lets
// in. Nothing near a pole and for a radius that is none.
[[nodiscard]] std::optional<std::vector<vertex>> polygon_of_circle(const vertex& centre, double radius_m,
                                                                   fence_kind kind);

} // namespace godwit::mission
