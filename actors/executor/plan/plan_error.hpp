// Why a mission can not be said to a vehicle: which item, what is wrong with it, and what can be done. Thread: plain
// values.
#pragma once

#include <cstddef>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::executor::plan {

enum class plan_errc {
  unknown_vehicle,       // it has not said what it is
  no_such_item,          // the plan shall begin behind the end of the mission
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

constexpr auto enum_names(plan_errc) {
  return io::names<plan_errc>({{plan_errc::unknown_vehicle, "unknown_vehicle"},
                               {plan_errc::no_such_item, "no_such_item"},
                               {plan_errc::nothing_to_fly, "nothing_to_fly"},
                               {plan_errc::no_take_off, "no_take_off"},
                               {plan_errc::late_take_off, "late_take_off"},
                               {plan_errc::no_direction, "no_direction"},
                               {plan_errc::no_place, "no_place"},
                               {plan_errc::no_approach, "no_approach"},
                               {plan_errc::too_steep, "too_steep"},
                               {plan_errc::circle_not_kept, "circle_not_kept"},
                               {plan_errc::wait_too_long, "wait_too_long"},
                               {plan_errc::return_point_not_home, "return_point_not_home"},
                               {plan_errc::no_return_point, "no_return_point"},
                               {plan_errc::area_too_large, "area_too_large"},
                               {plan_errc::area_too_small, "area_too_small"},
                               {plan_errc::too_many_lines, "too_many_lines"},
                               {plan_errc::command_not_allowed, "command_not_allowed"},
                               {plan_errc::command_refused, "command_refused"},
                               {plan_errc::jump_left_out, "jump_left_out"},
                               {plan_errc::too_many_items, "too_many_items"}});
}

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
