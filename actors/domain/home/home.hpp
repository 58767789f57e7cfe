// Whether two homes are the same: a return to one of them is a return to the other. Metres. Thread: pure.
#pragma once

#include <optional>

#include "messages/flight/home_place.hpp"

namespace godwit::flight {

inline constexpr double same_home_within_m = 15;       // over the ground
inline constexpr double same_home_height_within_m = 2; // the altitudes of a plan count from there

inline constexpr double moved_height_m = 15; // autopilots correct the height of a home by a few metres themselves

// Over the ground; 0 where one of them is no place.
[[nodiscard]] double distance_m(const home_place& one, const home_place& other);
// Somebody has put it elsewhere: a return leads to another place, or altitudes count from another height.
[[nodiscard]] bool is_moved(const home_place& now, const home_place& before);
// Of a vehicle that was armed where its home was BEFORE: arming leaves it there, and TOLD is the first that it reports
// after that. Somebody has moved it in between, when it lies elsewhere. None before: it was not armed at its home.
[[nodiscard]] home_place home_of_arming(const home_place& told, const std::optional<home_place>& before);
[[nodiscard]] bool is_same_home(const home_place& one, const home_place& other);

} // namespace godwit::flight
