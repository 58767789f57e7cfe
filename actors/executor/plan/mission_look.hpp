// What an item has to know of the items around it. Thread: pure.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "messages/mission/document.hpp"

namespace godwit::executor::plan {

// The first place that is flown to after item INDEX and before the next take-off; of a survey its first corner. None
// where the vehicle returns to its home, which a mission does not know.
[[nodiscard]] std::optional<mission::vertex> place_after(const mission::document& mission, std::size_t index);

// From where a vehicle comes to item INDEX, as far as the mission says it: a place of the item before it that has one,
// else the return point, the planned home, or its own first place. Not where the vehicle really is: a survey must have
// the same lines whenever it is planned.
[[nodiscard]] mission::vertex place_before(const mission::document& mission, std::size_t index);

// The speed that the items before INDEX have asked for last; none where that was a command.
[[nodiscard]] std::optional<double> speed_before(const mission::document& mission, std::size_t index);

// The commands before item INDEX, from item 0 on, that have set what a vehicle forgets: the last one of each kind, by
// their indices in order. A trigger that was switched off again, and a region of interest that was given up, are none.
[[nodiscard]] std::vector<std::size_t> state_before(const mission::document& mission, std::size_t index);

// The last item before INDEX that is a waypoint of the mission, and no place that an operator has sent the vehicle to:
// where the line begins that leads on from there.
[[nodiscard]] std::optional<std::size_t> waypoint_before(const mission::document& mission, std::size_t index);

// How high the flight took off that had begun before item INDEX; none where a take-off of its own comes next, and where
// that height was not one above home.
[[nodiscard]] std::optional<double> take_off_before(const mission::document& mission, std::size_t index);

// Nothing is flown between item INDEX and a landing.
[[nodiscard]] bool leads_to_landing(const mission::document& mission, std::size_t index);

} // namespace godwit::executor::plan
