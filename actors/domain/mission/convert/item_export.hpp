// The items of a mission as a ground station's plan has them; the way back of item_import.hpp.
//
// Surveys are the caller's business: a plan knows them as a pattern, a list of items does not. Thread: pure.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "actors/domain/mission/convert/loss.hpp"
#include "actors/domain/mission/convert/vehicle_item.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {

// None for a survey, two for a waypoint with a speed, else one. Numbers are left 0, and what is not given is NaN. Where
// a jump leads is left 0.
[[nodiscard]] std::vector<vehicle_item> vehicle_items_of(const item& each);

// For each item of the mission what it comes to, numbered from FIRST on, with jumps that lead there.
using numbered_items = std::vector<std::vector<vehicle_item>>;
[[nodiscard]] numbered_items numbered_items_of(const document& mission, std::size_t first, bool counts_surveys);

// The place of the planned home in a file: that of the mission, else its return point, else 0/0, which is none.
[[nodiscard]] planned_home home_to_write(const document& mission);

// Items at latitude 0 and longitude 0 can not be said to a vehicle, which takes that for "no place". What came as a
// command means it so.
void add_place_losses(std::span<const item> items, loss_list& losses);

} // namespace godwit::mission
