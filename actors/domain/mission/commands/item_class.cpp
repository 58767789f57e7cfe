#include "actors/domain/mission/commands/item_class.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "io/mavlink/enums.hpp"

namespace godwit::mission {

namespace {

using io::mavlink::mav_cmd;

bool is_one_of(const item& each, mav_cmd one, mav_cmd other) {
  const auto* const command = std::get_if<command_item>(&each);
  return command != nullptr &&
         (command->command == io::mavlink::number(one) || command->command == io::mavlink::number(other));
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
  return std::holds_alternative<takeoff>(each) || is_one_of(each, mav_cmd::nav_takeoff, mav_cmd::nav_vtol_takeoff);
}

bool is_landing(const item& each) {
  return std::holds_alternative<land>(each) || std::holds_alternative<return_home>(each) ||
         is_one_of(each, mav_cmd::nav_land, mav_cmd::nav_vtol_land);
}

command_state state_of(const item& each) {
  if (std::holds_alternative<change_speed>(each))
    return command_state::speed;
  const auto* const command = std::get_if<command_item>(&each);
  const auto* const row = command == nullptr ? nullptr : command_of(command->command);
  return row == nullptr ? command_state::none : row->state;
}

std::optional<std::size_t> index_of(std::span<const item> items, std::string_view id) {
  const auto found = std::ranges::find_if(items, [&](const item& each) { return id_of(each) == id; });
  return found == items.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - items.begin()));
}

bool has_place(const command_item& each) {
  const auto* const row = command_of(each.command);
  return row != nullptr && row->has_place;
}

std::optional<vertex> place_of(const command_item& each) {
  const auto& latitude = each.params[latitude_param];
  const auto& longitude = each.params[longitude_param];
  if (!has_place(each) || !latitude || !longitude || (*latitude == 0 && *longitude == 0))
    return std::nullopt;
  return vertex{*latitude, *longitude};
}

bool is_here(const command_item& each) { return has_place(each) && !place_of(each); }

} // namespace godwit::mission
