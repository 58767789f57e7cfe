#include "actors/executor/plan/fence_check.hpp"

#include <algorithm>
#include <limits>

#include "actors/domain/route/clear_space.hpp"

namespace godwit::executor::plan {

namespace {

using route::altitude_band;
using route::flat_polygon;
using route::segment;

constexpr double endless = std::numeric_limits<double>::infinity();

geo::point point_of(const mission::position& at) { return {at.latitude, at.longitude}; }

// The fences of a mission as far as they are looked at, each with its ground in the plane.
class fence_judge {
public:
  fence_judge(const mission::document& mission, const geo::point& origin) : mission_(mission), projection_(origin) {
    for (const auto& each : mission.geofences)
      areas_.emplace_back(each.vertices, projection_);
  }

  [[nodiscard]] segment flat(const mission::position& from, const mission::position& to) const {
    return {projection_.to_local(point_of(from)), projection_.to_local(point_of(to))};
  }

  [[nodiscard]] bool is_in_exclusion(std::size_t fence, const segment& way, const altitude_band& altitudes) const {
    const auto& area = areas_[fence];
    return is_of(fence, mission::fence_kind::exclusion) && route::meets(mission_.geofences[fence], altitudes) &&
           (area.contains(way.from) || area.has_sides_within(route::edge_width_m, way));
  }

  // Where on WAY the inclusions that reach over the altitudes end; nothing: nowhere, or there are none at all.
  [[nodiscard]] std::optional<double> leaves_inclusions_at(const segment& way, const altitude_band& altitudes) const {
    std::vector<const flat_polygon*> areas;
    bool has_any = false;
    for (std::size_t i = 0; i < areas_.size(); ++i) {
      if (!is_of(i, mission::fence_kind::inclusion))
        continue;
      has_any = true;
      if (route::has_all_of(mission_.geofences[i], altitudes))
        areas.push_back(&areas_[i]);
    }
    return has_any ? route::leaves_at(areas, way, 0) : std::nullopt;
  }

  // The first inclusion with AT on its ground.
  [[nodiscard]] std::optional<std::size_t> inclusion_around(const route::local_point& at) const {
    for (std::size_t i = 0; i < areas_.size(); ++i)
      if (is_of(i, mission::fence_kind::inclusion) && areas_[i].contains(at))
        return i;
    return std::nullopt;
  }

  [[nodiscard]] std::size_t size() const { return areas_.size(); }
  [[nodiscard]] const mission::geofence& fence(std::size_t i) const { return mission_.geofences[i]; }

private:
  [[nodiscard]] bool is_of(std::size_t i, mission::fence_kind kind) const { return mission_.geofences[i].kind == kind; }

  const mission::document& mission_;
  geo::local_projection projection_;
  std::vector<flat_polygon> areas_;
};

// A vehicle without altitudes is everywhere in an exclusion, and nowhere too high or too low in an inclusion.
struct looked_at {
  altitude_band excluded;
  altitude_band included;
};

looked_at altitudes_of(const leg& each, vehicle_class vehicle) {
  if (vehicle == vehicle_class::rover)
    return {{-endless, endless}, {endless, -endless}};
  const altitude_band all{std::min(each.from.altitude_m, each.to.altitude_m),
                          std::max(each.from.altitude_m, each.to.altitude_m)};
  const bool touches_ground = each.kind == leg_kind::climb || each.kind == leg_kind::descent;
  return {all, {touches_ground ? endless : all.lowest_m, all.highest_m}};
}

std::string fence_name(std::size_t i) { return "geofence " + std::to_string(i); }

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

// Why an inclusion ends there: another altitude is wanted, or another place.
violation violation_at(const fence_judge& judge, const segment& way, double share, const looked_at& altitudes,
                       const std::string& who) {
  const bool has_place = !judge.leaves_inclusions_at(way, {endless, -endless});
  const auto around = judge.inclusion_around(has_place ? route::at_share(way, share) : way.from);
  if (!around)
    return {violation_kind::outside_inclusion, {}, {}, {}, who + " lies outside of all inclusion fences."};
  if (!has_place)
    return {violation_kind::outside_inclusion,
            around,
            {},
            {},
            who + " leaves " + fence_name(*around) + ", which it has to stay in."};
  const bool is_low = judge.fence(*around).floor_m.value_or(-endless) > altitudes.included.lowest_m;
  return {is_low ? violation_kind::below_floor : violation_kind::above_ceiling,
          around,
          {},
          {},
          who + (is_low ? " goes below the floor of " : " goes above the ceiling of ") + fence_name(*around) + "."};
}

std::vector<violation> violations_of(const fence_judge& judge, const segment& way, const looked_at& altitudes,
                                     const std::string& who) {
  std::vector<violation> found;
  if (const auto share = judge.leaves_inclusions_at(way, altitudes.included))
    found.push_back(violation_at(judge, way, *share, altitudes, who));
  for (std::size_t i = 0; i < judge.size(); ++i)
    if (judge.is_in_exclusion(i, way, altitudes.excluded))
      found.push_back(
          {violation_kind::inside_exclusion, i, {}, {}, who + " comes into " + fence_name(i) + ", which excludes it."});
  return found;
}

} // namespace

std::vector<violation> fence_violations(const flight_plan& plan, const mission::document& mission,
                                        vehicle_class vehicle) {
  std::vector<violation> all;
  if (plan.legs.empty() || mission.geofences.empty())
    return all;
  const fence_judge judge(mission, point_of(plan.legs.front().from));
  for (std::size_t i = 0; i < plan.legs.size(); ++i) {
    const auto& each = plan.legs[i];
    const auto way = judge.flat(each.from, each.to);
    for (auto& found : violations_of(judge, way, altitudes_of(each, vehicle), way_name(each, mission))) {
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
  const fence_judge judge(mission, point_of(mission.return_point));
  const auto way = judge.flat(mission.return_point, mission.return_point);
  auto all = violations_of(judge, way, {{-endless, endless}, {endless, -endless}}, "The return point");
  if (all.size() > max_violations)
    all.resize(max_violations);
  return all;
}

} // namespace godwit::executor::plan
