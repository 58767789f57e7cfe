#include "actors/executor/plan/straight_return.hpp"

#include <algorithm>

#include "actors/domain/geofence/fence_set.hpp"
#include "actors/executor/plan/places.hpp"

namespace godwit::executor::plan {
namespace {

using geo::local_point;
using geofence::fence_set;

// Never in one without an area: of a leg that leads home.
bool is_in_triangle(const local_point& at, const local_point& a, const local_point& b, const local_point& c) {
  const double sides[] = {cross(b - a, at - a), cross(c - b, at - b), cross(a - c, at - c)};
  return std::ranges::all_of(sides, [](double each) { return each > 0; }) ||
         std::ranges::all_of(sides, [](double each) { return each < 0; });
}

// A fence that touches no side of the triangle may still lie in it.
bool lies_within(const geofence::fence& fence, const geo::point& a, const geo::point& b, const geo::point& c) {
  const auto first = fence.area().flat(a, b);
  const auto last = fence.area().flat(c, c).from;
  return is_in_triangle(fence.area().flat().corners().front(), first.from, first.to, last);
}

geofence::altitude_band altitudes_of(const leg& each, const plan_setting& setting) {
  if (setting.vehicle == vehicle_class::rover)
    return {};
  const auto [low, high] = std::minmax(each.from.altitude_m, each.to.altitude_m);
  return {low, std::max(high, setting.return_altitude_m)};
}

bool is_in_the_way(const fence_set& fences, std::size_t index, const leg& each, const geo::point& home,
                   const geofence::altitude_band& altitudes) {
  const auto from = point_of(each.from);
  const auto to = point_of(each.to);
  const auto& fence = fences[index];
  if (fence.is_inclusion() || !fence.altitudes().meets(altitudes))
    return false;
  return fences.excludes(index, from, home, altitudes) || fences.excludes(index, to, home, altitudes) ||
         lies_within(fence, from, to, home);
}

} // namespace

std::vector<return_crossing> straight_return_crossings(const flight_plan& plan, const mission::document& mission,
                                                       const plan_setting& setting) {
  const auto fences = fence_set::build(mission.geofences);
  std::vector<return_crossing> all;
  if (!fences || plan.legs.empty())
    return all;
  const auto home = point_of(home_of(setting));
  for (const auto& each : plan.legs)
    for (std::size_t i = 0; i < fences->size(); ++i) {
      const return_crossing found{each.item_index, i};
      if (is_in_the_way(*fences, i, each, home, altitudes_of(each, setting)) &&
          std::ranges::find(all, found) == all.end())
        all.push_back(found);
    }
  return all;
}

} // namespace godwit::executor::plan
