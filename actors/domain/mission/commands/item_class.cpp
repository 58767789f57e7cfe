#include "actors/domain/mission/commands/item_class.hpp"

#include <type_traits>
#include <variant>

namespace godwit::mission {

namespace {

constexpr std::uint16_t nav_land = 21;
constexpr std::uint16_t nav_takeoff = 22;
constexpr std::uint16_t nav_vtol_takeoff = 84;
constexpr std::uint16_t nav_vtol_land = 85;

bool has_place(const command_item& each) {
  const auto* const row = command_of(each.command);
  return row != nullptr && row->has_place;
}

} // namespace

command_class class_of(const item& each) {
  return std::visit(
      []<class T>(const T& value) {
        if constexpr (std::is_same_v<T, command_item>) {
          const auto* const row = command_of(value.command);
          return row == nullptr ? command_class::moves : row->kind;
        } else if constexpr (std::is_same_v<T, jump>) {
          return command_class::flow;
        } else if constexpr (std::is_same_v<T, change_speed>) {
          return command_class::acts;
        } else {
          return command_class::moves;
        }
      },
      each);
}

bool is_take_off(const item& each) {
  const auto* const command = std::get_if<command_item>(&each);
  return std::holds_alternative<takeoff>(each) ||
         (command != nullptr && (command->command == nav_takeoff || command->command == nav_vtol_takeoff));
}

bool is_landing(const item& each) {
  const auto* const command = std::get_if<command_item>(&each);
  return std::holds_alternative<land>(each) || std::holds_alternative<return_home>(each) ||
         (command != nullptr && (command->command == nav_land || command->command == nav_vtol_land));
}

command_state state_of(const item& each) {
  if (std::holds_alternative<change_speed>(each))
    return command_state::speed;
  const auto* const command = std::get_if<command_item>(&each);
  const auto* const row = command == nullptr ? nullptr : command_of(command->command);
  return row == nullptr ? command_state::none : row->state;
}

std::optional<vertex> place_of(const command_item& each) {
  constexpr std::size_t latitude = 4;
  constexpr std::size_t longitude = 5;
  const auto& params = each.params;
  if (!has_place(each) || !params[latitude] || !params[longitude] ||
      (*params[latitude] == 0 && *params[longitude] == 0))
    return std::nullopt;
  return vertex{*params[latitude], *params[longitude]};
}

bool is_here(const command_item& each) { return has_place(each) && !place_of(each); }

} // namespace godwit::mission
