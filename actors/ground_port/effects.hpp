// What the core of ground_port wants done, in this order. Thread: plain values.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "actors/ground_port/state.hpp"
#include "io/link/status.hpp"
#include "io/mavlink/frame.hpp"
#include "messages/executor/types.hpp"
#include "messages/ground_port/operator_link.hpp"
#include "messages/operator/types.hpp"

namespace godwit::ground_port {

struct transmission {
  io::link::peer_id to = io::link::every_peer;
  io::mavlink::frame_buffer frame;
};

// The executor is asked; its answer comes back with the request's number.
struct start_request_to_executor {
  std::uint64_t request = 0;
  executor::set_current what;
};

// The same of an operator's word.
struct word_to_say {
  std::uint64_t request = 0;
  operators::command what;
};

// To be made durable. What comes of it is given to on_durable.
using durable_event = durable_core::event;

using effect = std::variant<transmission, start_request_to_executor, word_to_say, durable_event, operator_link>;
using effects = std::vector<effect>;

} // namespace godwit::ground_port
