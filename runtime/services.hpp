// Everything that comes to the actors from outside, in one bundle: time, durable memory, trace, names, health, planned
// crashes. Whoever composes the process owns the parts and keeps them alive longer than the actor system. Thread: each
// part says its own.
#pragma once

#include <cstdint>

#include "runtime/actor_ref.hpp"
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

// What the guardian gives an incarnation on its way. An actor's constructor hands it on to actor_base and does not look
// at it. Thread: a value.
class incarnation;

struct spawn_context {
  const services* outside = nullptr;
  actor_ref address;           // a stable_address
  std::uint64_t number = 0;    // of the incarnation, from 1
  actor_ref supervisor;        // the guardian
  recovered restored;          // empty for actors without durable state
  incarnation* host = nullptr; // what the scheduler runs; it owns the actor
};

} // namespace godwit::runtime
