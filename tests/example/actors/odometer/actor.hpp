// The odometer as an actor: moves messages between its mailbox, its core and its listener. It decides nothing.
#pragma once

#include <utility>

#include "runtime/durable_actor.hpp"
#include "tests/example/actors/odometer/core.hpp"
#include "tests/example/messages/odometer/handle.hpp"

namespace godwit::odometer {

class actor final : public runtime::durable_actor<handle, core> {
public:
  // The context is the runtime's business and is handed on; what the actor has to know comes after it.
  actor(runtime::spawn_context context, listener_handle listener)
      : durable_actor(std::move(context)), listener_(std::move(listener)) {}

protected:
  behavior_type handlers() override;
  void dispatch(const effect& each) override;

private:
  listener_handle listener_;
};

} // namespace godwit::odometer
