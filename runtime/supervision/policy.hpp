// What a supervisor is told about its children, in the words of Erlang/OTP (supervisor, man page) and F´ (Svc/Health).
// Thread: plain values.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

#include "io/fields/field_table.hpp"

namespace godwit::runtime {

using std::chrono::milliseconds;

enum class strategy {
  one_for_one,  // only the crashed child is started again
  rest_for_one, // the children started after it are stopped, in reverse order, and started again after it
};

// More than `intensity` crashes within `period` and the child is given up. The first crash in a period is followed by a
// restart at once; from the second on the wait doubles from backoff_initial to backoff_max, changed at random by
// +-jitter, so that children that crash together do not come back together.
// With `for_ever` it is never given up, and the waits stay at backoff_max.
struct restart_policy {
  static constexpr std::uint32_t for_ever = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t intensity = 5;
  milliseconds period{60'000};
  milliseconds backoff_initial{100};
  milliseconds backoff_max{5'000};
  double jitter = 0.2; // fraction of the wait
  GODWIT_FIELDS(restart_policy, "runtime.restart_policy", intensity, period, backoff_initial, backoff_max, jitter);
};

// A ping goes out every `period`. An answer later than `warn` is a warning, later than `fatal` counts as a crash.
struct ping_policy {
  milliseconds period{1'000};
  milliseconds warn{3'000};
  milliseconds fatal{10'000};
  GODWIT_FIELDS(ping_policy, "runtime.ping_policy", period, warn, fatal);
};

// How the process ends because of a child that can not be kept up.
enum class process_end {
  in_order, // every child is stopped in its turn
  fast_once // a vehicle flies: within half a second, and only if the composition says that it helps; else it goes on
};

GODWIT_ENUM_NAMES(process_end, in_order, fast_once);

struct child_policy {
  bool essential = false; // given up or hanging: the process ends, and the service manager starts it again
  restart_policy restart;
  process_end end = process_end::in_order; // also of a child that is not essential and whose recovery hangs
  GODWIT_FIELDS(child_policy, "runtime.child_policy", essential, restart, end);
};

// Where a child stands: supervision_core.hpp draws how it goes on from there. Thread: constants.
enum class child_phase { absent, starting, running, stopping, waiting, given_up };

GODWIT_ENUM_NAMES(child_phase, absent, starting, running, stopping, waiting, given_up);

} // namespace godwit::runtime
