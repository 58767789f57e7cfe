#include "actors/domain/mission/convert/item_import.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace godwit::mission {

namespace {

constexpr double at_home_m = 10; // a take-off as near as this is meant to be at home
constexpr const char* left_out = "left out";

double given_or_zero(double value) { return std::isfinite(value) ? value : 0; }

double metres_between(const vertex& a, const vertex& b) {
  constexpr double metres_a_degree = 111'195;
  const auto north = (a.latitude - b.latitude) * metres_a_degree;
  const auto east = (a.longitude - b.longitude) * metres_a_degree * std::cos(a.latitude * std::numbers::pi / 180);
  return std::hypot(north, east);
}

std::string new_id(std::size_t count) { return "item-" + std::to_string(count + 1); }

} // namespace

import_context context_of(const std::optional<planned_home>& home, bool is_for_px4,
                          std::optional<vehicle_profile> vehicle) {
  const bool has_px4 = vehicle ? is_px4(*vehicle) : is_for_px4;
  if (!home)
    return {{}, {}, has_px4, vehicle};
  return {vertex{home->latitude, home->longitude}, home->above_sea_m, has_px4, vehicle};
}

void item_importer::append(item each, source_place where) {
  std::visit([&](auto& value) { value.id = new_id(items_.size()); }, each);
  items_.push_back(std::move(each));
  places_.push_back(std::move(where));
}

void item_importer::append(const vehicle_item& from, item each) {
  append(std::move(each), {from.place, "item " + std::to_string(from.number) + ", " + command_name(from.command)});
}

// A rover needs no take-off, and its landing is a place to stop at: a mission says both in its own way.
bool item_importer::is_executed(const vehicle_item& each) {
  const auto* const row = command_of(each.command);
  if (!context_.vehicle || row == nullptr)
    return true;
  const auto vehicle = "a vehicle of the kind " + std::string(io::name_of(*context_.vehicle));
  const bool is_said_otherwise = each.command == command::takeoff || each.command == command::land;
  switch (row->answer_of(*context_.vehicle)) {
  case item_answer::taken:
    return true;
  case item_answer::skipped:
    if (is_said_otherwise)
      return true;
    lose(each, "the item", vehicle + " takes it and passes it over", left_out);
    return false;
  case item_answer::refused:
    break;
  }
  lose(each, "the item", vehicle + " refuses a mission with it", left_out);
  return false;
}

// NaN is "as usual" (MAVLink, MISSION_ITEM_INT); infinity is nothing that a vehicle could do.
bool item_importer::is_infinite(const vehicle_item& each) {
  for (std::size_t n = 1; n <= 4; ++n)
    if (std::isinf(each.param(n))) {
      lose(each, "the item", "its parameter " + std::to_string(n) + " is infinite", left_out);
      return true;
    }
  return false;
}

void item_importer::take(const vehicle_item& each) {
  if (!is_executed(each) || is_infinite(each))
    return;
  if (!each.autocontinue)
    lose(each, "stop after the item (autocontinue off)", "a mission goes on by itself", "goes on");
  switch (each.command) {
  case command::vtol_takeoff:
    if (!is(vehicle_profile::arducopter))
      lose(each, "transition to flying forward", "a mission has no transitions", "taken as NAV_TAKEOFF");
    return take_takeoff(each);
  case command::takeoff:
    return take_takeoff(each);
  case command::spline_waypoint:
    lose(each, "curved way", "the legs of a mission are straight", "taken as NAV_WAYPOINT");
    return take_waypoint(each);
  case command::waypoint:
    return take_waypoint(each);
  case command::loiter_time:
    return take_loiter(each);
  case command::vtol_land:
    if (!is(vehicle_profile::arducopter))
      lose(each, "transition to hovering", "a mission has no transitions", "taken as NAV_LAND");
    return take_land(each);
  case command::land:
    return take_land(each);
  case command::return_to_launch:
    return append(each, return_home{{}, return_goal::home});
  case command::change_speed:
    return take_speed(each);
  default:
    lose(each, "the item", why_no_counterpart(each.command), left_out);
  }
}

void item_importer::take_takeoff(const vehicle_item& each) {
  const auto height = height_of(each);
  if (!height)
    return;
  if (!(*height > 0))
    return lose(each, "take-off to " + number_text(*height) + " m", "a take-off goes up", left_out);
  if (may_have_wings())
    expect_none(each, 1, "pitch of", "a take-off of a mission goes straight up");
  expect_no_yaw(each);
  if (!is(vehicle_profile::arducopter) && each.has_place() && context_.home &&
      metres_between({each.latitude(), each.longitude()}, *context_.home) > at_home_m)
    lose(each, "climb towards a place away from home", "a take-off of a mission goes straight up", "straight up");
  append(each, takeoff{{}, *height});
}

void item_importer::take_waypoint(const vehicle_item& each) {
  const auto place = place_of(each);
  if (!place)
    return;
  if (!is(vehicle_profile::arducopter) && !is(vehicle_profile::ardurover))
    expect_none(each, 3, "pass radius of", "a waypoint of a mission is flown to, not past");
  expect_no_yaw(each);
  append(each, waypoint{{}, *place, given_or_zero(each.param(1)), given_or_zero(each.param(2)), {}});
}

void item_importer::take_loiter(const vehicle_item& each) {
  if (!std::isfinite(each.param(1)))
    return lose(each, "the item", "it has no duration", left_out);
  const auto place = place_of(each);
  if (!place)
    return;
  expect_none(each, 2, "heading required:", "a mission leaves a circle when its time is over");
  expect_none(each, 4, "way out of the circle:", "a mission leaves it to the vehicle");
  append(each, loiter{{}, *place, given_or_zero(each.param(3)), each.param(1)});
}

void item_importer::take_land(const vehicle_item& each) {
  if (may_have_wings())
    expect_none(each, 1, "abort altitude of", "a mission leaves it to the vehicle");
  expect_none(each, 2, "precision landing mode", "a mission leaves it to the vehicle");
  expect_no_yaw(each);
  const auto height = height_of(each);
  if (!height)
    return;
  if (!each.has_place() && !last_place_)
    return lose(each, "the item", "it has no place, and no item before it has one", left_out);
  const auto place = each.has_place() ? vertex{each.latitude(), each.longitude()} : *last_place_;
  append(each, land{{}, {place.latitude, place.longitude, *height}});
}

void item_importer::take_speed(const vehicle_item& each) {
  const auto kind = given_or_zero(each.param(1));
  if (kind != 0 && kind != 1)
    return lose(each, "speed of climb or descent", "a mission has one speed", left_out);
  const auto throttle = given_or_zero(each.param(3));
  if (throttle > 0)
    lose(each, "throttle of " + number_text(throttle) + " %", "a mission has no throttle", left_out);
  if (!(each.param(2) > 0))
    return lose(each, "the item", "it asks for no speed of its own", left_out);
  append(each, change_speed{{}, each.param(2)});
}

void item_importer::lose(const vehicle_item& each, const std::string& what, std::string why, std::string instead) {
  losses_.add({each.number, command_name(each.command) + ": " + what, std::move(why), std::move(instead),
               each.place.starts_with("line") ? each.place : std::string()});
}

void item_importer::expect_none(const vehicle_item& each, std::size_t from_1, const std::string& what,
                                std::string why) {
  if (const auto value = given_or_zero(each.param(from_1)); value != 0)
    lose(each, what + ' ' + number_text(value), std::move(why), left_out);
}

void item_importer::expect_no_yaw(const vehicle_item& each) {
  const auto yaw = is_for_ardupilot() ? not_given : each.param(4);
  if (std::isfinite(yaw) && (yaw != 0 || context_.is_for_px4))
    lose(each, "yaw of " + number_text(yaw) + " degrees", "a mission leaves it to the vehicle", left_out);
}

std::optional<double> item_importer::height_of(const vehicle_item& each) {
  if (!std::isfinite(each.altitude_m())) {
    lose(each, "the item", "it has no altitude", left_out);
    return std::nullopt;
  }
  switch (each.frame) {
  case frame::global_relative:
  case frame::global_relative_int:
    return each.altitude_m();
  case frame::global:
  case frame::global_int: {
    const auto what = "altitude of " + number_text(each.altitude_m()) + " m above mean sea level";
    if (!context_.home_altitude_m) {
      lose(each, what, "a mission counts from the place of take-off, whose altitude is not known", left_out);
      return std::nullopt;
    }
    const auto height = each.altitude_m() - *context_.home_altitude_m;
    lose(each, what, "a mission counts from the place of take-off, and the vehicle may start elsewhere",
         number_text(height) + " m above the planned home position");
    return height;
  }
  default:
    lose(each, "altitude in frame " + std::to_string(each.frame), "a mission counts from the place of take-off",
         left_out);
    return std::nullopt;
  }
}

std::optional<position> item_importer::place_of(const vehicle_item& each) {
  if (!each.has_place()) {
    lose(each, "the item", "it has no place", left_out);
    return std::nullopt;
  }
  const auto height = height_of(each);
  if (!height)
    return std::nullopt;
  last_place_ = vertex{each.latitude(), each.longitude()};
  return position{each.latitude(), each.longitude(), *height};
}

} // namespace godwit::mission
