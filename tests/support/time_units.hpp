// Units of time in nanoseconds. For tests.
#pragma once

#include <cstdint>

namespace godwit::tests {

inline constexpr std::int64_t ms = 1'000'000;
inline constexpr std::int64_t s = 1'000 * ms;

} // namespace godwit::tests
