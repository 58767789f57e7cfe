// What a ground station has uploaded, item by item, to a mission; and its fence to geofences.
//
// The items as item_import.hpp says. A take-off climbs where the vehicle stands, wherever its item is. A fence is a run
// of corners for each polygon, or a circle, which becomes a polygon as in fence_import.hpp. Errors: as values. Thread:
// pure. Source: MAVLink's mission protocol; MISSION_ITEM_INT (73), MAV_CMD_NAV_FENCE_*.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/domain/mission/commands/command_policy.hpp"
#include "actors/domain/mission/convert/conversion.hpp"
#include "actors/domain/mission/convert/vehicle_item.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::mission {

// Positions in degrees, whatever the item has.
[[nodiscard]] vehicle_item vehicle_item_of(const io::mavlink::mission_item_int& each);

struct imported_fence_list {
  std::vector<geofence> geofences;
  std::optional<position> breach_return_point; // where a breach leads the vehicle, as it knows it
};

struct item_list_options {
  std::string mission_id;     // UUID
  bool allow_partial = false; // take what can be taken; else a loss is an error
  imported_fence_list fence{};
  std::optional<vehicle_profile> vehicle; // who is to fly it; absent: any
  allowed_commands allowed;
};

struct imported_list {
  document mission;
  std::vector<std::uint16_t> places; // for each item of the mission: of the item in the list that it was made of
  loss_list losses;                  // empty unless allow_partial
};

[[nodiscard]] tl::expected<imported_list, conversion_error>
import_item_list(std::span<const io::mavlink::mission_item_int> uploaded, const item_list_options& options);

// Errors: a sentence for people.
[[nodiscard]] tl::expected<imported_fence_list, std::string>
import_fence_list(std::span<const io::mavlink::mission_item_int> items);

} // namespace godwit::mission
