// The private parts of actor_frame, for its source files. For runtime/ alone.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <string>

#include <caf/all.hpp>

#include "runtime/actor_frame.hpp"
#include "runtime/address/stable_address.hpp"
#include "runtime/caf_mail.hpp"
#include "runtime/envelope.hpp"
#include "runtime/journal/records.hpp"
#include "runtime/supervision/child_spec.hpp"

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

// What CAF schedules: one life of an actor. It owns the actor proper, hands it each envelope, and tells it when it
// ends. For runtime/ alone. Thread: CAF's workers, one at a time.
class incarnation final : public caf::event_based_actor {
public:
  incarnation(caf::actor_config& config, spawn_context context, const actor_maker& make);

  [[nodiscard]] const char* name() const override;
  void on_exit() override { frame_->leave(); }
  // Of the mailbox, by its name; null: it does not take the type.
  [[nodiscard]] const message_type* takes(std::string_view name) const { return frame_->handlers_.type_named(name); }

protected:
  caf::behavior make_behavior() override;

private:
  std::unique_ptr<actor_frame> frame_;
};

// A message that its handler could not take, as the dead-letter table keeps it for people to read. Thread: pure.

// The body as JSON, secrets left out; {"too_long":true} where it is longer than what the table keeps.
[[nodiscard]] dead_letter make_dead_letter(const envelope& m, std::int64_t at_ns, std::string sender, int crashes,
                                           std::string reason);

} // namespace godwit::runtime
