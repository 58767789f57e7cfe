// What an item of a mission does, whatever its kind (a command by the table of commands), and where it stands. Pure.
// Thread: any.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "actors/domain/mission/commands/command_table.hpp"
#include "messages/mission/item.hpp"

namespace godwit::mission {

// A command whose number is not known moves the vehicle, for all that anyone can say.
[[nodiscard]] command_class class_of(const item& each);

[[nodiscard]] inline bool moves_vehicle(const item& each) { return class_of(each) == command_class::moves; }

// It begins or ends a flight.
[[nodiscard]] bool is_take_off(const item& each);
[[nodiscard]] bool is_landing(const item& each);

[[nodiscard]] command_state state_of(const item& each);

// None: no item has this id.
[[nodiscard]] std::optional<std::size_t> index_of(std::span<const item> items, std::string_view id);

// By the table.
[[nodiscard]] bool has_place(const command_item& each);
// Latitude and longitude of a command that has some: not 0/0, which is "here" for ArduPilot.
[[nodiscard]] std::optional<vertex> place_of(const command_item& each);
// It has a place by the table, and none is given.
[[nodiscard]] bool is_here(const command_item& each);

} // namespace godwit::mission
