// What an odometer must not forget, and nothing else. Thread: plain value.
#pragma once

#include <cstdint>
#include <optional>

#include "io/fields/field_table.hpp"
#include "tests/example/messages/odometer/types.hpp"

namespace godwit::odometer {

struct state {
  std::uint64_t total_m = 0;
  std::optional<reset_done> last_reset; // the answer to give when the same reset is asked for again
  static constexpr int version = 2;     // 1: without last_reset
  GODWIT_FIELDS(state, "odometer.state", total_m, last_reset);
};

} // namespace godwit::odometer
