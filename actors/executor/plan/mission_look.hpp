// What an item has to know of the items around it. Thread: pure.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "messages/mission/document.hpp"

namespace godwit::executor::plan {

// The first place that is flown to after item INDEX and before the next take-off; of a survey its first corner. None
// where the vehicle returns to its home, which a mission does not know.
[[nodiscard]] std::optional<mission::vertex> place_after(const mission::document& mission, std::size_t index);

// From where a vehicle comes to item INDEX, as far as the mission says it: a place of the item before it that has one,
// else the return point, the planned home, or its own first place. Not where the vehicle really is: a survey must have
// the same lines whenever it is planned.
[[nodiscard]] mission::vertex place_before(const mission::document& mission, std::size_t index);

// The speed that the items before INDEX have asked for last.
[[nodiscard]] std::optional<double> speed_before(const mission::document& mission, std::size_t index);

// How high the flight took off that had begun before item INDEX; none where a take-off of its own comes next.
[[nodiscard]] std::optional<double> take_off_before(const mission::document& mission, std::size_t index);

// Nothing is flown between item INDEX and a landing.
[[nodiscard]] bool leads_to_landing(const mission::document& mission, std::size_t index);

} // namespace godwit::executor::plan
