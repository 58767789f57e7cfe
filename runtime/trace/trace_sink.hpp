// Where deliveries are recorded. One call for each message that an actor took, on the thread of that actor.
//
// Implementations: ring_trace (per-thread rings, a writer thread, MCAP files), memory_trace (tests). Thread: record()
// is called from many threads at once, must not block and must not throw.
#pragma once

#include <cstdint>

#include "runtime/envelope.hpp"

namespace godwit::runtime {

enum class outcome : std::uint8_t {
  handled,      // the handler returned
  crashed,      // the handler threw; the incarnation ends
  repetition,   // a durable effect that was seen before; the handler was not called
  not_accepted, // the mailbox type does not have this message
  fenced,       // an incarnation that had been replaced woke up; what it sent was held back
};

GODWIT_ENUM_NAMES(outcome, handled, crashed, repetition, not_accepted, fenced);

struct trace_entry {
  std::int64_t began = 0; // in the sink's ticks
  std::int64_t ended = 0;
  std::int64_t clock_ns = 0; // what the monotonic clock showed the handler; 0: it has asked for no time
  std::int64_t wall_ns = 0;  // the same of the wall clock
  std::uint64_t id = 0;
  std::uint64_t cause = 0;
  std::uint32_t actor = 0; // number of the stable address
  std::uint32_t sender = 0;
  std::uint32_t incarnation = 0;
  outcome how = outcome::handled;
};

class trace_sink {
public:
  trace_sink() = default;
  trace_sink(const trace_sink&) = delete;
  trace_sink& operator=(const trace_sink&) = delete;
  virtual ~trace_sink() = default;

  // The time in a unit of the sink's choice; as cheap as it can be.
  [[nodiscard]] virtual std::int64_t ticks() const noexcept = 0;

  // BODY points to a value of TYPE and is only read during the call.
  virtual void record(const trace_entry& entry, const message_type& type, const void* body) noexcept = 0;
};

} // namespace godwit::runtime
