#include "actors/executor/plan/way_home.hpp"

#include "actors/executor/plan/vehicle_items.hpp"
#include "runtime/assert.hpp"

namespace godwit::executor::plan {

namespace {

mission_item_int last_item(const std::vector<mission::waypoint>& turns, const plan_setting& setting,
                           const std::optional<mission::position>& to) {
  if (setting.vehicle != vehicle_class::rover)
    return to ? land_item(*to, setting) : return_item();
  const double altitude_m = turns.empty() ? 0 : turns.back().at.altitude_m;
  const auto home = to.value_or(mission::position{setting.home.latitude, setting.home.longitude, 0});
  return waypoint_item({home.latitude, home.longitude, altitude_m}, 0, 0, setting);
}

} // namespace

flight_plan way_home(const std::vector<mission::waypoint>& turns, const plan_setting& setting,
                     const std::optional<mission::position>& to) {
  flight_plan result;
  auto& items = result.items;
  if (keeps_home_as_item(setting))
    items.push_back(home_item(setting));
  result.map.first_sequence = static_cast<std::uint16_t>(items.size());
  result.map.start_sequence = result.map.first_sequence;
  if (setting.stops_camera)
    items.push_back(*setting.stops_camera);
  for (const auto& each : turns)
    items.push_back(waypoint_item(each.at, 0, each.accept_radius_m, setting));
  items.push_back(last_item(turns, setting, to));
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i].seq = static_cast<std::uint16_t>(i);
  items.at(result.map.start_sequence).current = 1;
  result.map.total = static_cast<std::uint16_t>(items.size() - result.map.first_sequence);
  GODWIT_ASSERT(progress::is_sound(result.map), "plan: the map of a way home has the return");
  return result;
}

} // namespace godwit::executor::plan
