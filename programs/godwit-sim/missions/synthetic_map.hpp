// Objects on the map that nobody has seen, for pulls of any size: the same ones for the same wish and seed. Thread:
// pure.
#pragma once

#include <cstdint>
#include <vector>

#include "messages/mission/map_objects.hpp"
#include "programs/godwit-sim/missions/settings.hpp"

namespace godwit::sim::missions {

inline constexpr std::size_t max_synthetic_objects = 200'000; // what a file of map objects holds at most
inline constexpr double synthetic_square_m = 30'000;          // so wide and so high

[[nodiscard]] std::vector<mission::map_object> synthetic_map(const map_request& wanted, std::uint64_t seed);

} // namespace godwit::sim::missions
