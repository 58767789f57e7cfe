// The odometer as an actor: moves messages between its mailbox, its core and its listener. It decides nothing.
#pragma once

#include <utility>

#include "runtime/persistent_cell.hpp"
#include "tests/example/actors/odometer/core.hpp"
#include "tests/example/messages/odometer/handle.hpp"

namespace godwit::odometer {

class actor final : public runtime::persistent_cell<handle, core> {
public:
  // Config and birth are the runtime's business and are handed on; what the actor has to know comes behind them.
  actor(auto& config, runtime::birth born, listener_handle listener)
      : persistent_cell(config, std::move(born)), listener_(std::move(listener)) {}

protected:
  behavior_type handlers() override;
  void let_out(const effect& each) override;

private:
  listener_handle listener_;
};

} // namespace godwit::odometer
