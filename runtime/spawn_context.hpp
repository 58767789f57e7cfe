// What the guardian gives an incarnation on its way. An actor's constructor hands it on to actor_base and does not look
// at it. Thread: a value.
#pragma once

#include <cstdint>

#include "runtime/actor_ref.hpp"
#include "runtime/services.hpp"

namespace godwit::runtime {

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
