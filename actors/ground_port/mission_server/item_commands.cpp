#include "actors/ground_port/mission_server/item_commands.hpp"

#include "actors/domain/mission/commands/command_table.hpp"

namespace godwit::ground_port::mission_server {

namespace {

using mavlink::mav_mission_type;
using mission::command_class;

bool is_of(const mission::command_row& row, mav_mission_type type) {
  if (type == mav_mission_type::fence || type == mav_mission_type::rally)
    return row.kind == (type == mav_mission_type::fence ? command_class::fence : command_class::rally);
  return row.is_taken_by_anyone() && row.kind != command_class::fence && row.kind != command_class::rally &&
         row.kind != command_class::never;
}

} // namespace

std::optional<item_place> place_of(std::uint16_t command, mav_mission_type type) {
  const auto* const row = mission::command_of(command);
  if (row == nullptr || !is_of(*row, type))
    return std::nullopt;
  return row->has_place ? item_place::at_a_position : item_place::anywhere;
}

} // namespace godwit::ground_port::mission_server
