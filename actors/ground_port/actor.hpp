// The port for ground stations as an actor: the vehicle's role towards them, played for the executor.
//
// The decisions are in core.hpp. This shell drains what has come in, hands each thing to the core, and executes the
// effects: frames to the wire, events to the journal, requests to the executor, the operator's link to those
// who listen. A crash loses no line and no queue (they are the port's) and nothing that a station was told; a transfer
// under way is forgotten, and the station asks again. Thread: as actor_base.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "actors/ground_port/core.hpp"
#include "actors/line/line_actor.hpp"
#include "io/link/wire.hpp"
#include "messages/executor/handle.hpp"
#include "messages/failsafe/types.hpp"
#include "messages/ground_port/handle.hpp"
#include "messages/operator_bridge/handle.hpp"
#include "messages/vehicle_link/handle.hpp"

namespace godwit::ground_port {

using io::link::wire;

// The executor has answered a command by then, also where the vehicle changes its mode first; and a change of the item
// when the vehicle has taken it, with a few tries.
inline constexpr std::chrono::seconds command_patience{3};
inline constexpr std::chrono::seconds current_patience{10};

// Who has control is asked for once, and told at each change; a question that is not answered is put again.
inline constexpr std::chrono::seconds control_patience{2};

// A person's message waits for so long for the executor, which answers it without the disk.
inline constexpr std::chrono::milliseconds act_patience{1'000};

// Who has to hear of a person that has the vehicle, where the executor does not answer.
using takeover_listener = runtime::mailbox<runtime::tells<failsafe::taken_over>>;

// Who knows who has control, and keeps the audit.
using bridge_handle = runtime::mailbox<runtime::asks<operator_bridge::get_operators, operator_bridge::operators_view>,
                                       runtime::tells<operator_bridge::audit_note>>;

// Whom the port speaks with. Filled in while the process is composed, when the addresses of all actors exist, and not
// changed after the actors were started.
struct peers {
  std::optional<executor::station_handle> executor;  // none: missions are taken and shown, and not started
  std::optional<vehicle_link::relay_handle> vehicle; // none: nothing is passed on
  std::optional<takeover_listener> failsafe;
  std::optional<bridge_handle> bridge; // none: there are no operators beside the stations
  std::vector<operator_ear> operator_ears;
};

class actor final : public line::line_actor<own_handle, durable_core, core, wake, signing_time_reserved> {
public:
  // CONFIGURED has no objection_to.
  actor(runtime::spawn_context context, settings configured, signing_settings signing, std::shared_ptr<wire> line,
        std::shared_ptr<const peers> others);
  ~actor() override;

protected:
  behavior_type handlers() override;
  void started() override;
  void dispatch(const durable_core::effect& each) override;

private:
  template <class M>
  auto hears();
  void execute(const effects& wanted) override;
  void execute(const transmission& each) { queue_frame(each); }
  void execute(const durable_event& each) { commit(each); }
  void execute(const start_request_to_executor& each);
  void execute(const word_to_say& each);
  void execute(const pass_on& each);
  void execute(const act_to_ask& each);
  void execute(const acknowledgement_to_tell& each);
  void execute(const tell_taken_over&);
  void execute(const audit_row_to_tell& each);
  void execute(const operator_link& each);
  void ask_who_has_control();

  settings settings_;
  signing_settings signing_;
  std::shared_ptr<const peers> others_;
};

} // namespace godwit::ground_port
