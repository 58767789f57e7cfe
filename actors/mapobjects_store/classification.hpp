// Which known object a sighting is, and what that makes of it.
//
// The nearest candidate within reach; of equally near ones the one with the smallest id, so that the order in which
// candidates came on the map, or are read from it, does not matter. Distances are geodesic, altitude does not count.
// Thread: pure.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "actors/domain/geo/point.hpp"
#include "actors/mapobjects_store/settings.hpp"
#include "messages/mapobjects_store/observation.hpp"

namespace godwit::mapobjects_store {

// A known object of the sighting's class group.
struct candidate {
  std::string id;
  geo::point at;
};

struct match {
  std::size_t index = 0; // among the candidates
  double distance_m = 0;
};

[[nodiscard]] std::optional<match> nearest_match(const geo::point& seen_at, std::span<const candidate> candidates,
                                                 const settings& rules);

// IGNORED: the ignore list names the cell of the sighting, or that of the object which it is.
[[nodiscard]] observation_kind kind_of(const std::optional<match>& found, bool ignored, const settings& rules);

// Whether an observation of this kind is news for the operator.
[[nodiscard]] bool is_finding(observation_kind kind);

} // namespace godwit::mapobjects_store
