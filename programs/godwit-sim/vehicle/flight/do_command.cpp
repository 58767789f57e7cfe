#include "programs/godwit-sim/vehicle/flight/do_command.hpp"

#include <algorithm>

#include "actors/domain/mission/commands/command_table.hpp"
#include "programs/godwit-sim/vehicle/flight/item_place.hpp"
#include "programs/godwit-sim/vehicle/flight/mission_commands.hpp"

namespace godwit::sim {

using io::mavlink::mission_item_int;
using mission::command_class;

namespace {

// Who is slower than this never arrives; faster than this a step is no longer small.
constexpr double min_speed_mps = 0.1;
constexpr double max_speed_mps = 20;
constexpr float craft_default = -2;

std::optional<std::string> change(double& speed_mps, float wanted_mps, double own_mps, double least_mps) {
  if (wanted_mps == craft_default)
    speed_mps = own_mps;
  else if (wanted_mps > 0)
    speed_mps = std::clamp(static_cast<double>(wanted_mps), least_mps, max_speed_mps);
  else if (wanted_mps != -1) // -1 keeps it
    return "it names no speed";
  return std::nullopt;
}

std::optional<std::string> change_speed(const mission_item_int& command, const craft& what, pace& how_fast) {
  const auto own = own_pace(what);
  if (command.param1 == 0 || command.param1 == 1)
    return change(how_fast.speed_mps, command.param2, own.speed_mps, std::max(min_speed_mps, what.min_speed_mps));
  if (command.param1 == 2)
    return change(how_fast.climb_mps, command.param2, own.climb_mps, min_speed_mps);
  if (command.param1 == 3)
    return change(how_fast.descent_mps, command.param2, own.descent_mps, min_speed_mps);
  return "this kind of speed is not known";
}

// By some vehicle, as an item. What is guarded is not known here.
bool is_executed(std::uint16_t command) {
  const auto* const row = mission::command_of(command);
  if (row == nullptr || !row->is_taken_by_anyone())
    return false;
  return row->kind == command_class::acts || row->kind == command_class::waits || row->kind == command_class::flow ||
         row->kind == command_class::moves;
}

} // namespace

std::optional<std::string> carry_out(const mission_item_int& command, const craft& what, const position& here,
                                     pace& how_fast, position& home) {
  switch (command.command) {
  case do_change_speed:
    return change_speed(command, what, how_fast);
  case do_set_home: {
    if (command.param1 == 1) {
      home = here;
      return std::nullopt;
    }
    const auto place = place_of(command, home, here);
    if (!place)
      return place.error();
    home = place->at;
    return std::nullopt;
  }
  case do_jump:
  case do_land_start:
  case condition_delay:
    return std::nullopt;
  default:
    break;
  }
  if (is_executed(command.command))
    return std::nullopt; // cameras, servos and the like: nothing here moves by it
  return "command " + std::to_string(command.command) + " is not known";
}

} // namespace godwit::sim
