// Why a mission can not be said to a vehicle: which item, what is wrong with it, and what can be done. Thread: plain
// values.
#pragma once

#include <cstddef>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::executor::plan {

enum class plan_errc {
  unknown_vehicle,       // it has not said what it is
  no_such_item,          // the plan shall begin after the end of the mission
  nothing_to_fly,        // no item moves the vehicle
  no_take_off,           // the vehicle stands on the ground, and something else comes first
  late_take_off,         // in the middle of a flight
  no_direction,          // a fixed wing takes off, and nothing tells where to
  no_place,              // latitude and longitude 0, which vehicles take for "here"
  no_approach,           // a fixed wing lands, and nothing leads down to it
  too_steep,             // the way down of a fixed wing
  circle_not_kept,       // the vehicle has a circle of its own only
  wait_too_long,         // for the number that the vehicle keeps
  return_point_not_home, // a fixed wing returns, and would return to somewhere else
  no_return_point,       // an item leads there, and the mission has none
  area_too_large,        // of a survey
  area_too_small,        // no line fits into it
  too_many_lines,        // of a survey
  command_not_allowed,   // no mission may hold it, or not without flight.allowed_commands
  command_refused,       // by this kind of vehicle
  jump_left_out,         // the item that a jump leads to is not in the rest of the mission
  too_many_items         // of the vehicle
};

GODWIT_ENUM_NAMES(plan_errc, unknown_vehicle, no_such_item, nothing_to_fly, no_take_off, late_take_off, no_direction,
                  no_place, no_approach, too_steep, circle_not_kept, wait_too_long, return_point_not_home,
                  no_return_point, area_too_large, area_too_small, too_many_lines, command_not_allowed, command_refused,
                  jump_left_out, too_many_items);

struct plan_error {
  plan_errc code{};
  std::size_t item_index = 0; // in the mission
  std::string item_id;        // empty: the mission as a whole
  std::string what;           // "A fixed wing needs a way down to its landing"
  std::string remedy;         // "put a waypoint in front of it, higher and some hundred metres away"

  // "Item 'down': a fixed wing ...; put a waypoint ...", for people.
  [[nodiscard]] std::string message() const {
    return (item_id.empty() ? "The mission: " : "Item '" + item_id + "': ") + what + "; " + remedy + ".";
  }
};

} // namespace godwit::executor::plan
