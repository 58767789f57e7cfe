#include "actors/executor/plan/fence_check.hpp"

#include <algorithm>
#include <utility>

#include "actors/domain/geofence/fence_name.hpp"
#include "actors/domain/geofence/fence_set.hpp"
#include "actors/executor/plan/places.hpp"

namespace godwit::executor::plan {

namespace {

using geofence::altitude_band;
using geofence::endless_m;
using geofence::fence_name;
using geofence::fence_set;

// What is judged: a leg of the plan, or a place.
struct piece {
  geo::point from;
  geo::point to;
  altitude_band excluded; // the altitudes that an exclusion must not have a part in
  altitude_band included; // and those that an inclusion has to reach over
  std::string who;
};

// The first inclusion with AT on its ground.
std::optional<std::size_t> inclusion_around(const fence_set& fences, const geo::point& at) {
  for (std::size_t i = 0; i < fences.size(); ++i)
    if (fences[i].is_inclusion() && fences[i].area().contains(at))
      return i;
  return std::nullopt;
}

std::string way_name(const leg& each, const mission::document& mission) {
  const auto id = "item '" + mission::id_of(mission.items.at(each.item_index)) + "'";
  switch (each.kind) {
  case leg_kind::climb:
    return "The climb of " + id;
  case leg_kind::circle:
    return "The circle of " + id;
  case leg_kind::descent:
    return "The way down of " + id;
  case leg_kind::cruise:
    break;
  }
  return "The way to " + id;
}

// A vehicle without altitudes is everywhere in an exclusion, and nowhere too high or too low in an inclusion.
piece piece_of(const leg& each, const mission::document& mission, vehicle_class vehicle) {
  piece result{point_of(each.from), point_of(each.to), {}, geofence::no_altitudes, way_name(each, mission)};
  if (vehicle == vehicle_class::rover)
    return result;
  result.excluded = {std::min(each.from.altitude_m, each.to.altitude_m),
                     std::max(each.from.altitude_m, each.to.altitude_m)};
  result.included = result.excluded;
  if (each.kind == leg_kind::climb || each.kind == leg_kind::descent)
    result.included.lowest_m = endless_m;
  return result;
}

// Why an inclusion ends there: another altitude is wanted, or another place.
violation violation_at(const fence_set& fences, const piece& way, double share) {
  const bool has_place = !fences.leaves_inclusions_at(way.from, way.to, geofence::no_altitudes);
  const geo::local_projection around(way.from);
  const auto stop = around.to_globe(share * around.to_local(way.to));
  const auto inside = inclusion_around(fences, has_place ? stop : way.from);
  const auto found = [&](violation_kind kind, const std::string& what) {
    return violation{kind, inside, {}, {}, way.who + what};
  };
  if (!inside)
    return found(violation_kind::outside_inclusion, " lies outside of all inclusion fences.");
  const auto name = fence_name(*inside);
  if (!has_place)
    return found(violation_kind::outside_inclusion, " leaves " + name + ", which it has to stay in.");
  if (fences[*inside].altitudes().lowest_m > way.included.lowest_m)
    return found(violation_kind::below_floor, " goes below the floor of " + name + ".");
  return found(violation_kind::above_ceiling, " goes above the ceiling of " + name + ".");
}

std::vector<violation> violations_of(const fence_set& fences, const piece& way) {
  std::vector<violation> found;
  if (const auto share = fences.leaves_inclusions_at(way.from, way.to, way.included))
    found.push_back(violation_at(fences, way, *share));
  for (std::size_t i = 0; i < fences.size(); ++i)
    if (fences.excludes(i, way.from, way.to, way.excluded))
      found.push_back({violation_kind::inside_exclusion,
                       i,
                       {},
                       {},
                       way.who + " comes into " + fence_name(i) + ", which excludes it."});
  return found;
}

// Fences that are none: what nobody can keep to, and so nothing is flown.
violation refusal(const std::string& why) {
  return {violation_kind::outside_inclusion, {}, {}, {}, "The fences can not be judged: " + why + "."};
}

} // namespace

std::vector<violation> fence_violations(const flight_plan& plan, const mission::document& mission,
                                        vehicle_class vehicle) {
  std::vector<violation> all;
  const auto fences = fence_set::build(mission.geofences);
  if (!fences)
    return {refusal(fences.error())};
  for (std::size_t i = 0; i < plan.legs.size(); ++i) {
    const auto& each = plan.legs[i];
    for (auto& found : violations_of(*fences, piece_of(each, mission, vehicle))) {
      found.leg = i;
      found.item_index = each.item_index;
      all.push_back(std::move(found));
      if (all.size() >= max_violations)
        return all;
    }
  }
  return all;
}

std::vector<violation> return_point_violations(const mission::document& mission) {
  if (!mission.return_point)
    return {};
  const auto fences = fence_set::build(mission.geofences);
  if (!fences)
    return {refusal(fences.error())};
  const auto at = point_of(*mission.return_point);
  auto all = violations_of(*fences, {at, at, {}, geofence::no_altitudes, "The return point"});
  if (all.size() > max_violations)
    all.resize(max_violations);
  return all;
}

} // namespace godwit::executor::plan
