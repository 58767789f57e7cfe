#include "programs/godwit-sim/vehicle/flight/item_legs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "programs/godwit-sim/vehicle/flight/item_place.hpp"

namespace godwit::sim {

using io::mavlink::mission_item_int;

namespace {

// Landings aim better than waypoints.
constexpr double landing_radius_m = 0.5;
// A VTOL that comes to its landing on its wings changes to its rotors there.
constexpr double vtol_brakes_m = 90;

// A VTOL stands still in the air while it is, or is wanted to be, on its rotors; what flies else, by its kind.
bool will_be_wing(const item_setting& setting) {
  const auto& vehicle = setting.vehicle;
  return vehicle.is_vtol() ? !setting.hovers : vehicle.is_fixed_wing();
}

double arrival_radius_m(const item_setting& setting) {
  const auto& craft = setting.vehicle.what();
  return craft.has_rotors && setting.hovers ? craft.hover_radius_m : craft.arrival_radius_m;
}

// NaN and what is negative mean none.
double seconds(float value) { return std::isfinite(value) && value > 0 ? static_cast<double>(value) : 0; }

double turning_s(const mission_item_int& item, const item_setting& setting) {
  constexpr double default_radius_m = 20;
  const double own_m = will_be_wing(setting) ? setting.vehicle.what().loiter_radius_m : default_radius_m;
  const double radius_m = std::isfinite(item.param3) && item.param3 != 0 ? std::abs(item.param3) : own_m;
  return seconds(item.param1) * 2 * std::numbers::pi * radius_m / setting.how_fast.speed_mps;
}

bool is_loiter(const mission_item_int& item) {
  return item.command == nav_loiter_unlim || item.command == nav_loiter_time || item.command == nav_loiter_turns ||
         item.command == nav_loiter_to_alt;
}

// On which a fixed wing stays there; 0: its own.
double circle_m(const mission_item_int& item, const mover& vehicle) {
  if (item.command == nav_loiter_to_alt)
    return std::isfinite(item.param2) ? static_cast<double>(item.param2) : 0;
  if (!is_loiter(item) || !std::isfinite(item.param3) || item.param3 == 0)
    return 0;
  return item.command == nav_loiter_turns
             ? static_cast<double>(item.param3)
             : std::copysign(vehicle.what().loiter_radius_m, static_cast<double>(item.param3));
}

// Who comes to a circle is there before its centre.
double wing_is_there_m(double radius_m, const mover& vehicle) {
  return vehicle.what().arrival_radius_m + (radius_m != 0 ? std::abs(radius_m) : vehicle.what().loiter_radius_m);
}

go_leg leg_to(const mission_item_int& item, const item_place& place, const item_setting& setting) {
  const bool is_waypoint = item.command == nav_waypoint || item.command == nav_spline_waypoint;
  const double radius_m = is_waypoint ? seconds(item.param2) : 0;
  const bool stops = !is_waypoint || seconds(item.param1) > 0 || !setting.goes_on;
  go_leg leg{place.at, radius_m > 0 ? radius_m : arrival_radius_m(setting), stops};
  leg.circle_m = circle_m(item, setting.vehicle);
  if (is_loiter(item) && will_be_wing(setting))
    leg.radius_m = wing_is_there_m(leg.circle_m, setting.vehicle);
  return leg;
}

// IS_ON_WINGS: of a VTOL.
leg_list takeoff_legs(const item_place& place, const item_setting& setting, bool is_on_wings) {
  const auto& craft = setting.vehicle.what();
  auto top = place.at;
  const bool has_altitude = place.has_own_altitude && place.at.altitude_m != setting.home.altitude_m;
  if (!has_altitude)
    top.altitude_m = setting.home.altitude_m + craft.takeoff_altitude_m;
  // Who flies higher already does not come down for it.
  const double floor_m = setting.vehicle.is_in_air() ? setting.vehicle.where().where.altitude_m
                                                     : setting.vehicle.ground_m() + min_flight_height_m;
  top.altitude_m = std::max(top.altitude_m, floor_m);
  leg_list legs;
  const bool is_on_runway = is_on_wings || setting.vehicle.is_fixed_wing();
  if (is_on_wings)
    legs.emplace_back(change_leg{false});
  legs.emplace_back(climb_leg{top.altitude_m});
  if (place.is_here || is_on_runway || !craft.takes_off_to_place)
    return legs;
  if (setting.vehicle.is_vtol())
    legs.emplace_back(change_leg{false});
  legs.emplace_back(go_leg{top, craft.arrival_radius_m, !setting.vehicle.is_vtol()});
  return legs;
}

// To the place at the height at which it comes, and then to that of the item.
leg_list to_altitude_legs(const mission_item_int& item, const item_place& place, const item_setting& setting) {
  auto first = leg_to(item, place, setting);
  const auto top_m = first.to.altitude_m;
  first.to.altitude_m = setting.vehicle.where().where.altitude_m;
  auto legs = legs_to(first, setting.vehicle);
  legs.emplace_back(climb_leg{top_m});
  return legs;
}

// At the height ABOVE; a VTOL.
leg_list down_on_rotors(const position& above, const mover& vehicle) {
  leg_list legs;
  if (vehicle.is_fixed_wing())
    legs = {go_leg{above, vtol_brakes_m, false}, change_leg{true}};
  legs.emplace_back(go_leg{above, landing_radius_m, true});
  legs.emplace_back(land_leg{});
  return legs;
}

leg_list vtol_landing_legs(const item_place& place, const item_setting& setting) {
  if (!setting.vehicle.is_in_air())
    return {stay_leg{}};
  if (place.is_here)
    return {change_leg{true}, land_leg{}};
  auto above = place.at;
  above.altitude_m = setting.here.altitude_m;
  auto legs = down_on_rotors(above, setting.vehicle);
  if (!setting.vehicle.what().lands_on_return) // a quadplane: a landing item of a plane never ends
    legs.emplace_back(stay_leg{});
  return legs;
}

// The item's altitude is the one to abort at: it comes there as high as it flies, and goes down.
leg_list landing_legs(const item_place& place, const item_setting& setting) {
  const auto& vehicle = setting.vehicle;
  if (vehicle.is_fixed_wing() && place.is_here)
    return {land_leg{}, stay_leg{}};
  if (vehicle.is_fixed_wing() && vehicle.is_in_air())
    return {touch_down_leg{place.at}, stay_leg{}};
  if (vehicle.is_fixed_wing())
    return {stay_leg{}};
  auto above = place.at;
  above.altitude_m = setting.here.altitude_m;
  if (vehicle.is_multirotor() && !vehicle.is_in_air())
    above.altitude_m = std::max(above.altitude_m, vehicle.ground_m() + vehicle.what().takeoff_altitude_m);
  const bool is_landed_there = vehicle.is_multirotor() && !vehicle.is_in_air() &&
                               between(vehicle.where().where, place.at).distance_m <= vehicle.what().arrival_radius_m;
  leg_list legs;
  if (!place.is_here && !is_landed_there)
    legs = legs_to({above, landing_radius_m, true}, vehicle);
  legs.emplace_back(land_leg{});
  return legs;
}

} // namespace

leg_list legs_to(const go_leg& place, const mover& vehicle) {
  go_leg there = place;
  leg_list legs;
  if (!vehicle.is_rover()) {
    there.to.altitude_m = std::max(there.to.altitude_m, vehicle.ground_m() + min_flight_height_m);
    if (!vehicle.is_in_air() && vehicle.is_multirotor())
      legs.emplace_back(climb_leg{there.to.altitude_m});
  }
  legs.emplace_back(there);
  return legs;
}

leg_list legs_home(const position& first_home, const mover& vehicle) {
  const auto home = vehicle.return_place(first_home);
  if (vehicle.is_rover())
    return {go_leg{home, vehicle.what().arrival_radius_m, true}};
  if (!vehicle.is_in_air())
    return {};
  auto above = home;
  if (vehicle.is_vtol() && vehicle.what().lands_on_return) {
    above.altitude_m = std::max(vehicle.where().where.altitude_m, home.altitude_m + vehicle.what().return_altitude_m);
    return down_on_rotors(above, vehicle);
  }
  if (vehicle.is_fixed_wing() || vehicle.is_vtol()) {
    above.altitude_m += vehicle.what().return_altitude_m;
    if (vehicle.is_multirotor())
      return {change_leg{false}, go_leg{above, wing_is_there_m(0, vehicle), true}, stay_leg{}};
    return {go_leg{above, wing_is_there_m(0, vehicle), true}, stay_leg{}};
  }
  above.altitude_m = std::max(vehicle.where().where.altitude_m, home.altitude_m + vehicle.what().return_altitude_m);
  return {climb_leg{above.altitude_m}, go_leg{above, landing_radius_m, true}, land_leg{}};
}

tl::expected<leg_list, std::string> legs_of(const mission_item_int& item, const item_setting& setting) {
  if (item.command == nav_return_to_launch)
    return legs_home(setting.home, setting.vehicle);
  if (item.command == nav_delay) {
    if (item.param1 < 0)
      return tl::unexpected(std::string("a delay until a time of day is not known"));
    return leg_list{wait_leg{seconds(item.param1)}};
  }
  const auto place = place_of(item, setting.home, setting.here);
  if (!place)
    return tl::unexpected(place.error());
  switch (item.command) {
  case nav_continue_and_change_alt:
    if (!setting.vehicle.is_fixed_wing())
      return tl::unexpected(std::string("only a fixed wing keeps its course and climbs"));
    return leg_list{climb_leg{place->at.altitude_m}};
  case nav_loiter_to_alt:
    if (setting.vehicle.is_rover())
      return tl::unexpected(std::string("a rover does not climb"));
    return to_altitude_legs(item, *place, setting);
  case nav_vtol_takeoff:
  case nav_takeoff: {
    if (setting.vehicle.is_rover())
      return tl::unexpected(std::string("a rover does not take off"));
    const auto& craft = setting.vehicle.what();
    const bool is_quadplane = craft.has_rotors && !craft.takes_off_to_place;
    return takeoff_legs(*place, setting, is_quadplane && item.command == nav_takeoff);
  }
  case nav_vtol_land:
    if (setting.vehicle.is_vtol())
      return vtol_landing_legs(*place, setting);
    return landing_legs(*place, setting);
  case nav_land:
    return landing_legs(*place, setting);
  case nav_waypoint:
  case nav_spline_waypoint:
  case nav_payload_place: // there, and on with the load: the ground is not found
  case nav_loiter_unlim:
  case nav_loiter_time:
  case nav_loiter_turns:
    break;
  default:
    return tl::unexpected("command " + std::to_string(item.command) + " is not known");
  }
  auto legs = legs_to(leg_to(item, *place, setting), setting.vehicle);
  if (item.command == nav_loiter_unlim)
    legs.emplace_back(stay_leg{});
  else if (item.command == nav_loiter_turns)
    legs.emplace_back(wait_leg{turning_s(item, setting)});
  else if (seconds(item.param1) > 0 && (is_loiter(item) || !will_be_wing(setting)))
    legs.emplace_back(wait_leg{seconds(item.param1)});
  return legs;
}

} // namespace godwit::sim
