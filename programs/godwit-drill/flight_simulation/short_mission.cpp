#include "programs/godwit-drill/flight_simulation/short_mission.hpp"

namespace godwit::drill {
namespace {

constexpr double home_latitude = 47.397742; // of the simulated vehicles, when they are given no other
constexpr double home_longitude = 8.545594;
constexpr double metres_of_latitude = 111'200;
constexpr double metres_of_longitude = 75'300; // there

} // namespace

mission::item place(const std::string& id, double north_m, double east_m, double up_m) {
  mission::waypoint result;
  result.id = id;
  result.at = {home_latitude + north_m / metres_of_latitude, home_longitude + east_m / metres_of_longitude, up_m};
  return result;
}

mission::item place(sim::personality who, const std::string& id, double north_m, double east_m) {
  const double factor = who == sim::personality::plane ? plane_goes_farther : 1;
  return place(id, factor * north_m, factor * east_m, sim::drives(who) ? 0 : 20);
}

mission::item way_home(sim::personality who, const std::string& id) {
  if (who == sim::personality::plane)
    return mission::land{id, {home_latitude, home_longitude, 0}};
  return mission::return_home{id};
}

mission::geofence fence_around(double metres) {
  const auto corner = [&](double north_m, double east_m) {
    return mission::vertex{home_latitude + north_m / metres_of_latitude, home_longitude + east_m / metres_of_longitude};
  };
  mission::geofence result;
  result.vertices = {corner(-metres, -metres), corner(-metres, metres), corner(metres, metres),
                     corner(metres, -metres)};
  return result;
}

mission::document short_mission(sim::personality who) {
  mission::document result;
  result.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  result.return_point = {home_latitude, home_longitude, 0};
  const bool drives = sim::drives(who);
  if (!drives)
    result.items.emplace_back(mission::takeoff{"up", 20});
  result.items.push_back(place(who, "w1", 60, 0));
  result.items.push_back(place(who, "w2", 60, 60));
  result.items.push_back(place(who, "w3", 0, 60));
  if (!drives)
    result.items.push_back(way_home(who));
  return result;
}

mission::document long_mission(sim::personality who) {
  constexpr int lines = 15;
  constexpr double apart_m = 20;
  constexpr double reach_m = 140; // to each side of home
  auto result = short_mission(who);
  const bool drives = sim::drives(who);
  result.items.clear();
  if (!drives)
    result.items.emplace_back(mission::takeoff{"up", 20});
  for (int i = 0; i < lines; ++i) {
    const double north_m = apart_m * i - reach_m;
    const double begins_m = i % 2 == 0 ? -reach_m : reach_m;
    result.items.push_back(place(who, "w" + std::to_string(2 * i + 1), north_m, begins_m));
    result.items.push_back(place(who, "w" + std::to_string(2 * i + 2), north_m, -begins_m));
  }
  if (!drives)
    result.items.push_back(way_home(who));
  return result;
}

mission::document with_landing_on_the_way() {
  auto result = short_mission(sim::personality::px4);
  const auto w1 = std::get<mission::waypoint>(result.items[1]).at;
  result.items = {result.items[0],           result.items[1],
                  mission::land{"drop", w1}, mission::takeoff{"up again", 20},
                  place("w2", 60, 60, 20),   mission::return_home{"home"}};
  return result;
}

} // namespace godwit::drill
