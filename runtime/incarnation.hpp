// What CAF schedules: one life of an actor. It owns the actor proper, hands it each envelope, and tells it when it
// ends. For runtime/ alone. Thread: CAF's workers, one at a time.
#pragma once

#include <memory>

#include <caf/all.hpp>

#include "runtime/actor_frame.hpp"
#include "runtime/supervision/child_spec.hpp"

namespace godwit::runtime {

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

} // namespace godwit::runtime
