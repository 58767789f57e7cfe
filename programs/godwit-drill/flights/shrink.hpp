// Finds the fewest faults with which a failing random flight still fails. Thread: pure; FAILS flies.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace godwit::drill {

// Which of FAULTS (0 to FAULTS - 1) can be left out: none of the others can be left out alone. FAILS is asked at most
// FAULTS * FAULTS times, with those that are left out.
[[nodiscard]] std::vector<std::uint64_t>
not_needed_to_fail(std::uint64_t faults, const std::function<bool(const std::vector<std::uint64_t>& without)>& fails);

} // namespace godwit::drill
