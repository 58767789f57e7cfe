// The items of a mission as a ground station's plan has them; the way back of item_import.hpp.
//
// Surveys are the caller's business: a plan knows them as a pattern, a list of items does not. Thread: pure.
#pragma once

#include <span>
#include <vector>

#include "actors/domain/mission/convert/loss.hpp"
#include "actors/domain/mission/convert/vehicle_item.hpp"
#include "messages/mission/document.hpp"

namespace godwit::mission {

// None for a survey, two for a waypoint with a speed, else one. Numbers are left 0, and what is not given is NaN.
[[nodiscard]] std::vector<vehicle_item> vehicle_items_of(const item& each);

// The place of the planned home in a file: that of the mission, else its return point, else 0/0, which is none.
[[nodiscard]] planned_home home_to_write(const document& mission);

// Items at latitude 0 and longitude 0 can not be said to a vehicle, which takes that for "no place".
void add_place_losses(std::span<const item> items, loss_list& losses);

} // namespace godwit::mission
