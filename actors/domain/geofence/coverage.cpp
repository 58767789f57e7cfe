#include "actors/domain/geofence/coverage.hpp"

#include <algorithm>
#include <vector>

namespace godwit::geofence {

namespace {

bool is_in(const way_over& each, double share, double margin_m) {
  return share >= each.counts.from && share <= each.counts.to &&
         each.area->contains_with_margin(geo::at_share(each.way, share), margin_m);
}

// Between two of them the answer is the same all along the way. A share too many does no harm.
std::vector<double> turning_shares(std::span<const way_over> areas, double margin_m) {
  std::vector<double> shares{0, 1};
  for (const auto& each : areas) {
    each.area->add_turning_shares(each.way, margin_m, shares);
    for (const double end : {each.counts.from, each.counts.to})
      if (end > 0 && end < 1)
        shares.push_back(end);
  }
  std::sort(shares.begin(), shares.end());
  return shares;
}

} // namespace

std::optional<double> leaves_at(std::span<const way_over> areas, double margin_m) {
  const auto is_covered = [&](double share) {
    return std::any_of(areas.begin(), areas.end(), [&](const auto& each) { return is_in(each, share, margin_m); });
  };
  const auto shares = turning_shares(areas, margin_m);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const bool is_new = i == 0 || shares[i] > shares[i - 1];
    if (is_new && i > 0 && !is_covered((shares[i - 1] + shares[i]) / 2))
      return shares[i - 1];
    if (is_new && !is_covered(shares[i]))
      return shares[i];
  }
  return std::nullopt;
}

} // namespace godwit::geofence
