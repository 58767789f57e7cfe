// What is said to and by the odometer. Plain values; distances in whole metres, times in nanoseconds since 1970 (UTC).
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"

namespace godwit::odometer {

// The vehicle went on. The type is the bound: one message is at most 65 km, and so causes at most 65 milestones.
struct moved {
  std::uint16_t distance_m = 0; // since the last `moved`
  GODWIT_FIELDS(moved, "odometer.moved", distance_m);
};

// Answered from memory, at once.
struct get_total {
  static constexpr auto fields = io::table("odometer.get_total");
};

struct total {
  std::uint64_t distance_m = 0;
  GODWIT_FIELDS(total, "odometer.total", distance_m);
};

// Start again at 0. Answered when it is on the disk. Who gets no answer asks again with the same key.
struct reset {
  std::uint64_t key = 0; // chosen by the asker before its first try, different for each reset that it means
  GODWIT_FIELDS(reset, "odometer.reset", key);
};

struct reset_done {
  std::uint64_t key = 0;
  std::uint64_t distance_m = 0; // what was counted until then
  GODWIT_FIELDS(reset_done, "odometer.reset_done", key, distance_m);
};

// A kilometre is full. Told to the listener once for each, also when the odometer crashes in between.
struct milestone {
  std::uint64_t kilometre = 0; // 1, 2, 3, ... since the last reset
  std::int64_t at_ns = 0;
  GODWIT_FIELDS(milestone, "odometer.milestone", kilometre, at_ns);
};

} // namespace godwit::odometer
