// How long news of the past may come, and how long a message is waited for. Times: nanoseconds. Thread: pure.
#pragma once

#include <cstdint>

namespace godwit::executor::progress {

// After a generation was opened, and after it was armed late, only its start counts: what else comes may be older. PX4
// repeats MISSION_ITEM_REACHED about once a second, and what it says of one moment came up to 0.65 s apart. Nothing is
// lost by it, because a vehicle goes on telling where it is.
inline constexpr std::int64_t settling_ns = 2'000'000'000;

// PX4 sends the MISSION_ITEM_REACHED of an item before or after the MISSION_CURRENT of the next one, up to 0.65 s
// apart. The item counts as left without one when this is over.
inline constexpr std::int64_t reached_late_ns = 1'000'000'000;

// A gripper reports that it has released its load half a second after the vehicle has gone on, a camera its picture up
// to a second after that. So long an act that may be confirmed waits for it.
inline constexpr std::int64_t outcome_late_ns = 2'000'000'000;

// A wall clock that was set back ends the wait: to wait for it could take years.
[[nodiscard]] constexpr bool is_over(std::int64_t since_ns, std::int64_t now_ns, std::int64_t span_ns) {
  return now_ns < since_ns || now_ns - since_ns >= span_ns;
}

} // namespace godwit::executor::progress
