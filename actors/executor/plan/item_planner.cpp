#include "actors/executor/plan/item_planner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/mission/commands/item_class.hpp"
#include "actors/executor/plan/change_ids.hpp"
#include "actors/executor/plan/mission_look.hpp"
#include "actors/executor/plan/places.hpp"
#include "actors/executor/plan/vehicle_items.hpp"

namespace godwit::executor::plan {

namespace {

template <class Place, class Other>
double between_m(const Place& a, const Other& b) {
  return geo::distance_m(point_of(a), point_of(b));
}

template <class Place, class Other>
bool is_same_place(const Place& a, const Other& b) {
  return between_m(a, b) <= same_place_m;
}

std::string whole(double value) { return std::to_string(std::lround(value)); }

} // namespace

std::optional<plan_error> item_planner::write(std::size_t index, std::uint32_t lines_before) {
  index_ = index;
  lines_before_ = lines_before;
  const auto& item = mission_.items.at(index);
  writer_.begin_item(mission::id_of(item), static_cast<std::uint32_t>(index));
  take_off_first();
  repeat_or_leave_line();
  return std::visit([&](const auto& each) { return plan(each); }, item);
}

std::optional<plan_error> item_planner::lead_in(std::size_t index) {
  index_ = index;
  writer_.begin_lead_in(static_cast<std::uint32_t>(index));
  take_off_first();
  if (auto problem = why_not_flown())
    return problem;
  const auto rest = std::span(mission_.items).subspan(index);
  const auto moving = std::ranges::find_if(rest, mission::moves_vehicle);
  if (moving == rest.end())
    return error(plan_errc::nothing_to_fly, "No item from there on moves the vehicle", "give it a place to go to");
  index_ = index + static_cast<std::size_t>(moving - rest.begin());
  repeat_or_leave_line();
  if (const auto place = position_of(*moving))
    writer_.cruise_to(*place);
  writer_.end_lead_in(mission::id_of(mission_.items[index]));
  return std::nullopt;
}

void item_planner::take_off_first() {
  if (!take_off_first_m_)
    return;
  auto up = writer_.start();
  up.altitude_m = take_off_altitude_m(*take_off_first_m_);
  writer_.climb_to(up.altitude_m);
  writer_.add_take_off(takeoff_item(up, setting_));
}

void item_planner::repeat_or_leave_line() {
  const auto& item = mission_.items.at(index_);
  const bool flies_on = writer_.is_in_air() || is(vehicle_class::rover);
  if (!rest_from_ || !flies_on || !mission::moves_vehicle(item) || mission::is_take_off(item) || writer_.is_branch())
    return;
  if (is_of_change(mission::id_of(item)))
    leave_line();
  else
    repeat_state();
}

item_planner::outcome item_planner::error(plan_errc code, std::string what, std::string remedy) const {
  return plan_error{code, index_, mission::id_of(mission_.items.at(index_)), std::move(what), std::move(remedy)};
}

bool item_planner::stands_at(const mission::position& at) const {
  return !writer_.began_under_way() && !writer_.has_moved() && is_same_place(writer_.start(), at);
}

bool item_planner::is_home(const mission::position& goal) const {
  return is_same_place(goal, setting_.home) && (writer_.began_under_way() || is_same_place(goal, writer_.start()));
}

// After a landing on higher ground: so much above the ground there, and never less above home than was asked for.
double item_planner::take_off_altitude_m(double asked_m) const {
  return setting_.is_home_set_again ? asked_m + std::max(0.0, writer_.start().altitude_m) : asked_m;
}

item_planner::outcome item_planner::why_not_flown() const {
  if (is(vehicle_class::rover) || writer_.is_in_air())
    return std::nullopt;
  return error(plan_errc::no_take_off, "The vehicle stands on the ground there", "put a takeoff in front of it");
}

item_planner::outcome item_planner::why_not_there(const mission::position& at) const {
  if (!is_nowhere(at))
    return std::nullopt;
  return error(plan_errc::no_place, "Its place is latitude 0 and longitude 0, which vehicles take for none",
               "move it by a metre");
}

item_planner::outcome item_planner::why_not_waited(double seconds) const {
  const double longest_s = longest_wait_s(setting_);
  if (seconds <= longest_s)
    return std::nullopt;
  return error(plan_errc::wait_too_long,
               "It waits for " + whole(seconds) + " s, and the vehicle knows " + whole(longest_s) + " s at most",
               "divide the time over several items");
}

item_planner::outcome item_planner::why_not_reached(const mission::position& at, double wait_s) const {
  if (auto problem = why_not_flown())
    return problem;
  if (auto problem = why_not_there(at))
    return problem;
  return why_not_waited(wait_s);
}

item_planner::outcome item_planner::plan(const mission::takeoff& item) {
  if (is(vehicle_class::rover))
    return std::nullopt;
  if (writer_.has_moved())
    return error(plan_errc::late_take_off, "A take-off does not come in the middle of a flight",
                 "put a waypoint there, which climbs as well, or a land in front of it");
  const bool is_plane = is(vehicle_class::fixed_wing);
  if (is_plane && writer_.is_in_air())
    return std::nullopt;
  auto towards = writer_.start();
  if (is_plane) {
    const auto next = place_after(mission_, index_);
    if (!next || between_m(towards, *next) < min_take_off_way_m)
      return error(plan_errc::no_direction,
                   "A fixed wing takes off towards the next place, and none is at least " + whole(min_take_off_way_m) +
                       " m away",
                   "put a waypoint after it, in the direction of the runway");
    towards = {next->latitude, next->longitude, 0};
  }
  towards.altitude_m = take_off_altitude_m(item.altitude_m);
  writer_.climb_to(towards.altitude_m);
  writer_.add_take_off(takeoff_item(towards, setting_));
  return std::nullopt;
}

// Holding at a waypoint is circling for a plane, which ignores the time of a NAV_WAYPOINT.
item_planner::outcome item_planner::plan(const mission::waypoint& item) {
  if (auto problem = why_not_reached(item.at, item.hold_s))
    return problem;
  const bool is_plane = is(vehicle_class::fixed_wing);
  if (is_plane && setting_.marks_landings && leads_to_landing(mission_, index_))
    writer_.mark_landing();
  if (item.speed_mps)
    writer_.set_speed(*item.speed_mps);
  writer_.cruise_to(item.at);
  if (!is_plane || item.hold_s <= 0) {
    writer_.add_nav(waypoint_item(item.at, item.hold_s, item.accept_radius_m, setting_));
    return std::nullopt;
  }
  writer_.add_nav(loiter_item(item.at, item.hold_s, 0, setting_));
  writer_.circle(setting_.own_loiter_radius_m);
  return std::nullopt;
}

item_planner::outcome item_planner::plan(const mission::loiter& item) {
  if (auto problem = why_not_reached(item.at, item.duration_s))
    return problem;
  const bool is_plane = is(vehicle_class::fixed_wing);
  const double off_m = std::abs(std::abs(item.radius_m) - setting_.own_loiter_radius_m);
  if (is_plane && is_ardupilot(setting_) && item.radius_m != 0 && off_m > same_radius_m)
    return error(plan_errc::circle_not_kept,
                 "It asks for circles of " + whole(std::abs(item.radius_m)) +
                     " m, and an ArduPilot plane flies its own of " + whole(setting_.own_loiter_radius_m) + " m",
                 "set radius_m to 0, and WP_LOITER_RAD in the vehicle");
  if (is_plane && setting_.marks_landings && leads_to_landing(mission_, index_))
    writer_.mark_landing();
  writer_.cruise_to(item.at);
  if (is(vehicle_class::rover)) {
    writer_.add_nav(waypoint_item(item.at, item.duration_s, 0, setting_));
    return std::nullopt;
  }
  writer_.add_nav(loiter_item(item.at, item.duration_s, item.radius_m, setting_));
  if (is_plane)
    writer_.circle(item.radius_m != 0 ? item.radius_m : setting_.own_loiter_radius_m);
  return std::nullopt;
}

item_planner::outcome item_planner::plan(const mission::change_speed& item) {
  writer_.set_speed(item.mps);
  return std::nullopt;
}

item_planner::outcome item_planner::why_not_glided(const mission::position& to) const {
  const auto& from = writer_.here();
  if (!writer_.comes_from_a_place() || from.altitude_m <= to.altitude_m)
    return error(plan_errc::no_approach, "A fixed wing comes down to its landing from a place that is higher",
                 "put a waypoint in front of it, higher and some hundred metres away");
  const double slope_rad = std::atan2(from.altitude_m - to.altitude_m, between_m(from, to));
  const double slope_deg = slope_rad * 180 / std::numbers::pi;
  if (slope_deg <= max_glide_slope_deg)
    return std::nullopt;
  return error(plan_errc::too_steep,
               "The way down to it has " + whole(slope_deg) + " degrees, and a fixed wing can " +
                   whole(max_glide_slope_deg),
               "put the waypoint in front of it lower or farther away");
}

item_planner::outcome item_planner::plan(const mission::land& item) {
  if (stands_at(item.at))
    return std::nullopt;
  if (auto problem = why_not_reached(item.at, 0))
    return problem;
  if (is(vehicle_class::rover)) {
    writer_.cruise_to(item.at);
    writer_.add_nav(waypoint_item(item.at, 0, 0, setting_));
    writer_.stop();
    return std::nullopt;
  }
  if (is(vehicle_class::fixed_wing)) {
    if (auto problem = why_not_glided(item.at))
      return problem;
  } else {
    writer_.cruise_to({item.at.latitude, item.at.longitude, writer_.here().altitude_m});
  }
  writer_.add_nav(land_item(item.at, setting_));
  writer_.descend_to(item.at);
  return std::nullopt;
}

item_planner::outcome item_planner::plan(const mission::return_home& item) {
  const bool is_own = item.to == mission::return_goal::home;
  if (!is_own && !mission_.return_point)
    return error(plan_errc::no_return_point, "It returns to the return point, and the mission has none",
                 "give the mission a return point, or send the vehicle to its home (\"to\": \"HOME\")");
  const auto goal = is_own ? home_of(setting_) : *mission_.return_point;
  if (stands_at(goal))
    return std::nullopt;
  if (auto problem = why_not_flown())
    return problem;
  if (!is_own && !is_home(goal))
    return return_by_places(goal);
  return_by_itself(goal);
  return std::nullopt;
}

void item_planner::return_by_itself(const mission::position& goal) {
  writer_.add_nav(return_item());
  if (is(vehicle_class::rover)) {
    writer_.cruise_to(goal);
    writer_.stop();
    return;
  }
  writer_.climb_to(setting_.return_altitude_m);
  writer_.cruise_to({goal.latitude, goal.longitude, writer_.here().altitude_m});
  writer_.descend_to(goal);
}

item_planner::outcome item_planner::return_by_places(const mission::position& goal) {
  if (is(vehicle_class::fixed_wing))
    return error(plan_errc::return_point_not_home,
                 "The vehicle would return to its home, and the return point is elsewhere",
                 "put a waypoint and a land in its place");
  if (auto problem = why_not_there(goal))
    return problem;
  if (is(vehicle_class::rover)) {
    writer_.cruise_to(goal);
    writer_.add_nav(waypoint_item(goal, 0, 0, setting_));
    writer_.stop();
    return std::nullopt;
  }
  const double altitude_m = std::max(writer_.here().altitude_m, setting_.return_altitude_m);
  writer_.climb_to(altitude_m);
  const mission::position above{goal.latitude, goal.longitude, altitude_m};
  writer_.cruise_to(above);
  writer_.add_nav(waypoint_item(above, 0, 0, setting_));
  writer_.add_nav(land_item(goal, setting_));
  writer_.descend_to(goal);
  return std::nullopt;
}

} // namespace godwit::executor::plan
