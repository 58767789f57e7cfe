// Commands of ground stations that go on to the vehicle and are not answered yet: until they are it is pending who has
// the vehicle, and nothing is sent.
//
//   (none) ──begin()──> pending ──acknowledge(): refused────────────────> (none), as before
//                          ├─────acknowledge(): accepted, in progress───> that station's person has it
//                          └─────silent for answered_within_ns──────────> the same
//
// ground_port matches the vehicle's COMMAND_ACK to what it has passed on. In memory alone: a new incarnation looks at
// the vehicle before anything. At the bound the oldest counts as accepted. Pure. Monotonic nanoseconds. Thread: one at
// a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "messages/executor/station_act.hpp"

namespace godwit::executor {

class pending_commands {
public:
  // A vehicle answers within tenths of a second, also over a radio that repeats.
  static constexpr std::int64_t answered_within_ns = 1'000'000'000;
  static constexpr std::size_t max_pending = 32;

  // The one that had to make room: it counts as accepted.
  [[nodiscard]] std::optional<station_act> begin(const station_act& what, std::int64_t now_ns);
  // What it was, where it is accepted; nothing: it was refused, or is not known any more.
  [[nodiscard]] std::optional<station_act> acknowledge(const act_acknowledged& m);
  // The oldest that was silent for too long.
  [[nodiscard]] std::optional<station_act> take_silent(std::int64_t now_ns);

  [[nodiscard]] bool is_pending() const { return !waiting_.empty(); }

private:
  struct waiting {
    station_act what;
    std::int64_t until_ns = 0;
  };
  std::vector<waiting> waiting_; // in the order in which they went on
};

} // namespace godwit::executor
