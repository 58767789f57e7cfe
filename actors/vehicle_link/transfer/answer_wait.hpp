// How long an answer of the vehicle is waited for at most. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/time_units.hpp"

namespace godwit::vehicle_link::transfer {

inline constexpr std::int64_t max_wait_ns = 1'000 * ns_per_ms;

} // namespace godwit::vehicle_link::transfer
