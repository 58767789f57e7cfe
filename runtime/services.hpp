// Everything that comes to the actors from outside, in one bundle: time, durable memory, trace, names, health, planned
// crashes. Whoever composes the process owns the parts and keeps them alive longer than the actor system. Thread: each
// part says its own.
#pragma once

#include <cstdint>

#include "runtime/clock.hpp"
#include "runtime/crash_points.hpp"
#include "runtime/directory.hpp"
#include "runtime/health_board.hpp"
#include "runtime/journal/journal.hpp"
#include "runtime/replay/replay_port.hpp"
#include "runtime/trace/trace_sink.hpp"

namespace godwit::runtime {

struct services {
  const time_source* time = nullptr;
  directory* names = nullptr;
  health_board* health = nullptr;
  journal* durable = nullptr;      // may be null when no actor is persistent
  trace_sink* trace = nullptr;     // null = no trace
  crash_points* crashes = nullptr; // null = none planned
  replay_port* replayed = nullptr; // null but where a recorded actor is replayed
  std::uint64_t seed = 0;          // for the jitter of restarts
};

} // namespace godwit::runtime
