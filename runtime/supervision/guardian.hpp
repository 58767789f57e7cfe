// The root of the actors: owns the stable addresses, watches the incarnations, executes what supervision_core
// decides.
//
// It holds no decision of its own and never restarts; if it dies, the process ends. Who runs, and what follows when a
// child can not be kept up, says the table of the supervisor; until it has said something, and while it is down, the
// last table holds. A child with durable state is
// started in two steps: the journal recovers it (after everything that the dead incarnation had queued), then the
// incarnation is made.
//
//   crash ──> leave(): mail parked ──> down ──> [journal: recover] ──> new incarnation, bind(): mail flows
//
// Thread: an actor; the functions at the end may be called from any thread.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <caf/all.hpp>

#include "runtime/frame_parts.hpp"
#include "runtime/supervision/child_spec.hpp"
#include "runtime/supervision/policy.hpp"

namespace godwit::runtime {

struct guardian_options {
  actor_ref self; // its stable address, for the ids of what it tells
  strategy how = strategy::one_for_one;
  ping_policy ping;
  milliseconds stop_timeout{2'000};     // for each child; then it is killed, and after as long again left behind
  milliseconds recovery_limit{10'000};  // then the journal is taken to hang, and the process ends
  std::vector<std::string> floor;       // children that no table can have stopped
  std::vector<child_entry> first_table; // holds until the supervisor sends one
  bool may_end_fast = false;            // see process_end::fast_once
  liveness_listener alive;
  std::function<void(exit_request)> on_exit_request; // any thread; the process should end in order
};

// Spawns the guardian; it starts the children when tell_guardian_to_start() says so.
[[nodiscard]] caf::strong_actor_ptr spawn_guardian(caf::actor_system& system, const services& outside,
                                                   std::vector<child_spec> children, guardian_options options,
                                                   supervisor_handle supervisor,
                                                   std::shared_ptr<guardian_status> status);

void tell_guardian_to_start(const caf::strong_actor_ptr& guardian);
void tell_guardian_to_stop(const caf::strong_actor_ptr& guardian);

} // namespace godwit::runtime
