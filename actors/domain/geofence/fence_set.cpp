#include "actors/domain/geofence/fence_set.hpp"

#include <algorithm>
#include <utility>

#include "actors/domain/geofence/coverage.hpp"
#include "actors/domain/geofence/fence_name.hpp"

namespace godwit::geofence {

namespace {

// On which part of a way from one altitude straight to another it is in the band.
std::optional<part> part_within(const altitude_band& band, double from_m, double to_m) {
  if (from_m == to_m)
    return band.contains(from_m) ? std::optional(part{}) : std::nullopt;
  const double climb_m = to_m - from_m;
  const auto [first, last] = std::minmax({(band.lowest_m - from_m) / climb_m, (band.highest_m - from_m) / climb_m});
  if (first > 1 || last < 0)
    return std::nullopt;
  return part{std::max(first, 0.0), std::min(last, 1.0)};
}

geo::segment piece_of(const geo::segment& way, const part& which) {
  return {geo::at_share(way, which.from), geo::at_share(way, which.to)};
}

} // namespace

std::string breach::sentence() const {
  return exclusion ? "it is in " + fence_name(*exclusion) + ", which excludes it"
                   : std::string("it is outside of all inclusion fences");
}

tl::expected<fence_set, std::string> fence_set::build(const std::vector<mission::geofence>& from) {
  if (from.size() > max_fences)
    return tl::unexpected(std::to_string(from.size()) + " fences are too many; at most " + std::to_string(max_fences) +
                          " are possible");
  fence_set result;
  for (std::size_t i = 0; i < from.size(); ++i) {
    auto one = fence::build(from[i]);
    if (!one)
      return tl::unexpected(fence_name(i) + " " + one.error());
    result.has_inclusions_ = result.has_inclusions_ || one->is_inclusion();
    result.fences_.push_back(std::move(*one));
  }
  return result;
}

std::optional<breach> fence_set::breach_on(const place& from, const place& to, bool floor_counts) const {
  std::vector<way_over> inclusions;
  for (std::size_t i = 0; i < fences_.size(); ++i) {
    const auto& each = fences_[i];
    auto band = each.altitudes();
    if (each.is_inclusion() && !floor_counts)
      band.lowest_m = -endless_m;
    const auto counts = part_within(band, from.altitude_m, to.altitude_m);
    if (!counts)
      continue;
    const auto way = each.area().flat(from.at, to.at);
    if (each.is_inclusion())
      inclusions.push_back({&each.area().flat(), way, *counts});
    else if (each.area().flat().touches(piece_of(way, *counts)))
      return breach{i};
  }
  if (has_inclusions_ && leaves_at(inclusions, 0))
    return breach{};
  return std::nullopt;
}

bool fence_set::excludes(std::size_t index, const geo::point& from, const geo::point& to,
                         const altitude_band& altitudes) const {
  const auto& each = fences_[index];
  return !each.is_inclusion() && each.altitudes().meets(altitudes) &&
         each.area().flat().touches(each.area().flat(from, to));
}

std::optional<double> fence_set::leaves_inclusions_at(const geo::point& from, const geo::point& to,
                                                      const altitude_band& altitudes) const {
  if (!has_inclusions_)
    return std::nullopt;
  std::vector<way_over> inclusions;
  for (const auto& each : fences_)
    if (each.is_inclusion() && each.altitudes().has_all_of(altitudes))
      inclusions.push_back({&each.area().flat(), each.area().flat(from, to), {}});
  return leaves_at(inclusions, 0);
}

} // namespace godwit::geofence
