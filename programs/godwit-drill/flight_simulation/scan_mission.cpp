#include "programs/godwit-drill/flight_simulation/scan_mission.hpp"

#include <utility>

#include "programs/godwit-drill/flight_simulation/short_mission.hpp"

namespace godwit::drill {
namespace {

constexpr double south_m = 60; // of the survey, from home
constexpr double length_m = 300;
constexpr double width_m = 80;
constexpr double spacing_m = 20;

mission::vertex corner(double north_m, double east_m) {
  const auto at = std::get<mission::waypoint>(place("", north_m, east_m, 0)).at;
  return {at.latitude, at.longitude};
}

} // namespace

mission::document scan_mission(sim::personality who) {
  auto result = short_mission(who);
  const bool drives = sim::drives(who);
  mission::survey field;
  field.id = "field";
  field.polygon = {corner(south_m, 0), corner(south_m + length_m, 0), corner(south_m + length_m, width_m),
                   corner(south_m, width_m)};
  field.altitude_m = drives ? 0 : 20;
  field.line_spacing_m = spacing_m;
  field.heading_deg = 0;
  result.items.clear();
  if (!drives)
    result.items.emplace_back(mission::takeoff{"up", 20});
  result.items.push_back(place(who, "w1", 0, -60));
  result.items.emplace_back(std::move(field));
  result.items.push_back(drives ? place(who, "w2", 0, -60) : way_home(who));
  return result;
}

mapobjects_store::sighting seen_in_survey(const flight_simulation& flight, std::string id, double north_m,
                                          double confidence) {
  const auto at = corner(south_m + north_m, width_m / 2);
  mapobjects_store::sighting result;
  result.id = std::move(id);
  result.mission_id = flight.mission_id();
  result.class_group = "vehicle";
  result.position = {at.latitude, at.longitude, {}};
  result.at_ns = flight.wall_ns();
  result.confidence = confidence;
  return result;
}

bool is_in_survey(flight_simulation& flight) {
  const auto reports = flight.reports();
  return !reports.empty() && reports.back().kind == mission::progress_kind::started &&
         reports.back().item_id == "field";
}

} // namespace godwit::drill
