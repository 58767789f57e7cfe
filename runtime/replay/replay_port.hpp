// Where an actor that is replayed meets its bench: what it sends goes here and to nobody, and what came in beside its
// mailbox comes from the record. In flight there is none. Thread: the actor's.
#pragma once

#include <cstdint>

#include "runtime/envelope.hpp"
#include "runtime/internal_messages.hpp"

namespace caf {
class actor_control_block;
class mailbox_element;
} // namespace caf

namespace godwit::runtime {

class replay_port {
public:
  replay_port() = default;
  replay_port(const replay_port&) = delete;
  replay_port& operator=(const replay_port&) = delete;
  virtual ~replay_port() = default;

  // A tell, a question (ANSWER_TYPE: what it is to be answered with), an answer, or a message for later (DELAY_NS).
  virtual void take(caf::actor_control_block& to, const caf::mailbox_element& element, std::int64_t delay_ns,
                    const message_type* answer_type) = 0;

  // VALUE, of TYPE, becomes what was recorded; it is left as it is where nothing was.
  virtual void observed(const message_type& type, void* value) = 0;

  // VALUE, of TYPE, becomes the next one that was taken from beside the mailbox while this message was handled. False:
  // there was no further one.
  virtual bool taken(const message_type& type, void* value) = 0;

  // What the actor does beside messages.
  virtual void called(const outside_call& what) = 0;
};

} // namespace godwit::runtime
