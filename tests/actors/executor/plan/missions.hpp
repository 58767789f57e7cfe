// Missions and settings for tests of plans, in metres around one place. Thread: pure.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "actors/executor/plan/builder.hpp"
#include "messages/mission/document.hpp"
#include "tests/actors/domain/route/fences.hpp"

namespace godwit::executor::plan {

using io::mavlink::mav_autopilot;

inline mission::position at(double east_m, double north_m, double altitude_m) {
  const auto here = tests::place(east_m, north_m);
  return {here.latitude_deg, here.longitude_deg, altitude_m};
}

inline mission::waypoint waypoint(std::string id, const mission::position& place) {
  return {std::move(id), place, 0, 0, {}};
}

inline mission::survey survey_of(std::string id, const std::vector<geo::local_point>& corners, double spacing_m,
                                 std::optional<double> heading_deg = {}) {
  mission::survey result{std::move(id), {}, 50, spacing_m, heading_deg};
  for (const auto& each : corners)
    result.polygon.push_back(tests::corner(each.east_m, each.north_m));
  return result;
}

// The return point is where the vehicle stands and has its home.
inline mission::document mission_of(std::vector<mission::item> items) {
  mission::document result;
  result.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  result.items = std::move(items);
  result.return_point = at(0, 0, 0);
  return result;
}

inline plan_setting setting_of(vehicle_class vehicle, mav_autopilot autopilot = mav_autopilot::px4) {
  plan_setting result;
  result.vehicle = vehicle;
  result.autopilot = autopilot;
  result.start = at(0, 0, 0);
  result.home = {result.start.latitude, result.start.longitude, 431, 0};
  return result;
}

inline const plan_setting px4_copter = setting_of(vehicle_class::multirotor);
inline const plan_setting ardupilot_copter = setting_of(vehicle_class::multirotor, mav_autopilot::ardupilotmega);
inline const plan_setting px4_plane = setting_of(vehicle_class::fixed_wing);
inline const plan_setting ardupilot_plane = setting_of(vehicle_class::fixed_wing, mav_autopilot::ardupilotmega);
inline const plan_setting rover = setting_of(vehicle_class::rover, mav_autopilot::generic);

// The commands of a plan in their order, home left out.
inline std::vector<int> commands_of(const flight_plan& plan) {
  std::vector<int> commands;
  for (const auto& each : plan.items)
    if (each.seq >= plan.map.first_sequence)
      commands.push_back(each.command);
  return commands;
}

// Of all plans, one after the other.
inline std::vector<int> commands_of(const mission::document& mission, const plan_setting& setting,
                                    const plan_from& from = {}) {
  std::vector<int> commands;
  const auto plans = build_plans(mission, setting, from);
  if (!plans)
    return commands;
  for (const auto& each : *plans)
    for (const int command : commands_of(each))
      commands.push_back(command);
  return commands;
}

inline std::string why_not(const mission::document& mission, const plan_setting& setting, const plan_from& from = {}) {
  const auto plans = build_plans(mission, setting, from);
  return plans ? "" : plans.error().message();
}

} // namespace godwit::executor::plan
