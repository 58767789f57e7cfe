// What travels in front of every message: which one it is, what caused it, who sent it and, where the message is a
// durable effect, which one, so that a receiver can tell a repetition. Thread: plain values.
#pragma once

#include <cstdint>

namespace godwit::runtime {

struct header {
  std::uint64_t id = 0;          // below 2^53, so that JSON readers keep it exact; 0 = none
  std::uint64_t cause = 0;       // id of the message whose handler sent this one; 0 = from outside
  std::int64_t effect_event = 0; // event number of the durable effect; 0 = not a durable effect
  std::uint32_t effect_n = 0;    // which effect of that event
  std::uint32_t sender = 0;      // number of the sender's stable address; 0 = outside
};

} // namespace godwit::runtime
