// What a fault does to an answer on its way. Thread: pure.
#pragma once

#include <cstdint>

#include "programs/godwit-sim/missions/delivery.hpp"
#include "programs/godwit-sim/missions/fault.hpp"

namespace godwit::sim::missions {

inline constexpr std::uint64_t huge_body_bytes = std::uint64_t{1} << 30;

// True: the service must not see the request, because nothing is to change.
[[nodiscard]] bool keeps_from_service(const fault::any& what);

// Faults of connections do nothing here.
void apply(const fault::any& what, delivery& to);

} // namespace godwit::sim::missions
