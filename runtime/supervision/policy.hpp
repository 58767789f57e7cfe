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
  static constexpr auto fields = io::table(
      "runtime.restart_policy", io::field("intensity", &restart_policy::intensity),
      io::field("period", &restart_policy::period), io::field("backoff_initial", &restart_policy::backoff_initial),
      io::field("backoff_max", &restart_policy::backoff_max), io::field("jitter", &restart_policy::jitter));
};

// A ping goes out every `period`. An answer later than `warn` is a warning, later than `fatal` counts as a crash.
struct ping_policy {
  milliseconds period{1'000};
  milliseconds warn{3'000};
  milliseconds fatal{10'000};
  static constexpr auto fields =
      io::table("runtime.ping_policy", io::field("period", &ping_policy::period), io::field("warn", &ping_policy::warn),
                io::field("fatal", &ping_policy::fatal));
};

// How the process ends because of a child that can not be kept up.
enum class process_end {
  in_order, // every child is stopped in its turn
  fast_once // a vehicle flies: within half a second, and only if the composition says that it helps; else it goes on
};

constexpr auto enum_names(process_end) {
  return io::names<process_end>({{process_end::in_order, "in_order"}, {process_end::fast_once, "fast_once"}});
}

struct child_policy {
  bool essential = false; // given up or hanging: the process ends, and the service manager starts it again
  restart_policy restart;
  process_end end = process_end::in_order; // also of a child that is not essential and whose recovery hangs
  static constexpr auto fields =
      io::table("runtime.child_policy", io::field("essential", &child_policy::essential),
                io::field("restart", &child_policy::restart), io::field("end", &child_policy::end));
};

} // namespace godwit::runtime
