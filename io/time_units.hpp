// How many of a unit of time another one has. Thread: plain values.
#pragma once

#include <cstdint>

namespace godwit {

inline constexpr std::int64_t ns_per_us = 1'000;
inline constexpr std::int64_t ns_per_ms = 1'000'000;
inline constexpr std::int64_t ns_per_s = 1'000'000'000;

} // namespace godwit
