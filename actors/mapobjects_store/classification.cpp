#include "actors/mapobjects_store/classification.hpp"

#include <tuple>

#include "actors/domain/geo/geodesic.hpp"

namespace godwit::mapobjects_store {

std::optional<match> nearest_match(const geo::point& seen_at, std::span<const candidate> candidates,
                                   const settings& rules) {
  std::optional<match> best;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double distance_m = geo::distance_m(seen_at, candidates[i].at);
    if (distance_m > rules.match_within_m)
      continue;
    const bool better =
        !best || std::tie(distance_m, candidates[i].id) < std::tie(best->distance_m, candidates[best->index].id);
    if (better)
      best = match{i, distance_m};
  }
  return best;
}

observation_kind kind_of(const std::optional<match>& found, bool ignored, const settings& rules) {
  if (ignored)
    return observation_kind::ignored;
  if (!found)
    return observation_kind::found;
  return found->distance_m > rules.moved_above_m ? observation_kind::moved : observation_kind::existing;
}

bool is_finding(observation_kind kind) {
  return kind == observation_kind::found || kind == observation_kind::moved ||
         kind == observation_kind::removed_candidate;
}

} // namespace godwit::mapobjects_store
