// The link to the autopilot as an actor: others ask it to command the vehicle and to move plans, and hear what it says.
//
// The decisions are in core.hpp. This shell drains what has come in, hands each thing to the core, and executes the
// effects: frames to the wire, answers to whoever asked, observations to the listeners, the state of the link to the
// health board. A crash loses no line and no queue (they are the port's); who waited for an answer is told that the
// outcome is not known. Errors: see the outcome types. Thread: as actor_base.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "actors/line/line_actor.hpp"
#include "actors/vehicle_link/core.hpp"
#include "actors/vehicle_link/listeners.hpp"
#include "actors/vehicle_link/state.hpp"
#include "io/link/wire.hpp"
#include "messages/vehicle_link/handle.hpp"

namespace godwit::vehicle_link {

using io::link::wire;

class actor final : public line::line_actor<own_handle, durable_core, core, wake, signing_time_reserved> {
public:
  actor(runtime::spawn_context context, settings configured, signing_settings signing, std::shared_ptr<wire> line,
        std::shared_ptr<const listeners> ears);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;
  void dispatch(const durable_core::effect& each) override;
  [[nodiscard]] bool goes_on_without_disk() const override { return true; } // stops have to come through

private:
  void execute(const effects& wanted) override;
  void execute(const transmission& each) { queue_frame(each); }
  void execute(const resolved_command& each);
  void execute(const resolved_transfer& each);
  void execute(const resolved_look& each);
  void execute(const observation& each);
  void execute(const announcement& each);

  settings settings_;
  signing_settings signing_;
  std::shared_ptr<const listeners> ears_;
};

} // namespace godwit::vehicle_link
