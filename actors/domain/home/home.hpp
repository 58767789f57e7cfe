// Whether two homes are the same: a return to one of them is a return to the other. Metres. Thread: pure.
#pragma once

#include "messages/flight/home_place.hpp"

namespace godwit::flight {

inline constexpr double same_home_within_m = 15;       // over the ground
inline constexpr double same_home_height_within_m = 2; // the altitudes of a plan count from there

[[nodiscard]] bool is_same_home(const home_place& one, const home_place& other);

} // namespace godwit::flight
