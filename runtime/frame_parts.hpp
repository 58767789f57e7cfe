// The private parts of actor_frame, for its source files. For runtime/ alone.
#pragma once

#include <exception>
#include <string>

#include "runtime/actor_frame.hpp"
#include "runtime/caf_mail.hpp"
#include "runtime/stable_address.hpp"

namespace godwit::runtime {

// What a handler sends, until it returns.
struct actor_frame::held_message {
  caf::strong_actor_ptr to;
  caf::mailbox_element_ptr element;
  std::int64_t delay_ns = 0;
  std::uint64_t answers = 0;                 // id of the request that this is the late answer to
  const message_type* answer_type = nullptr; // of a question
};

// One message on its way through a handler.
struct actor_frame::delivery {
  std::int64_t began = 0;              // in ticks of the trace
  stable_address::requester requester; // empty for a tell
  caf::strong_actor_ptr effect_sender; // of a durable effect
  bool is_mail = true;                 // came through the address; an answer or a call of the runtime did not
};

// Mail that the incarnation keeps: put back after a crash, or not taken while its writes wait.
struct actor_frame::kept_mail {
  caf::mailbox_element_ptr element;
};

} // namespace godwit::runtime
