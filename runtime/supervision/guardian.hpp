// The root of the actors: owns the stable addresses, watches the incarnations, carries out what supervision_core
// decides.
//
// It holds no decision of its own and never restarts; if it dies, the process ends. A child with durable state is
// started in two steps: the journal recovers it (behind everything that the dead incarnation had queued), then the
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

#include "runtime/cell.hpp"
#include "runtime/seam.hpp"
#include "runtime/supervision/messages.hpp"
#include "runtime/supervision/policy.hpp"

namespace godwit::runtime {

using guardian_handle = mailbox<asks<get_children, children>, tells<set_policy>, tells<want_child>>;
using decider_handle = mailbox<tells<child_event>>;

struct child_spec {
  caf::strong_actor_ptr address;
  child_policy policy;
  bool persistent = false;
  // Makes an incarnation; may throw.
  std::function<caf::strong_actor_ptr(caf::actor_system&, birth)> make;
};

enum class exit_cause { requested, essential_given_up, essential_silent, no_free_worker, guardian_died };

constexpr auto enum_names(exit_cause) {
  return io::names<exit_cause>({{exit_cause::requested, "requested"},
                                {exit_cause::essential_given_up, "essential_given_up"},
                                {exit_cause::essential_silent, "essential_silent"},
                                {exit_cause::no_free_worker, "no_free_worker"},
                                {exit_cause::guardian_died, "guardian_died"}});
}

struct exit_request {
  exit_cause cause = exit_cause::requested;
  std::string reason; // a sentence for people
};

struct guardian_options {
  strategy how = strategy::one_for_one;
  ping_policy ping;
  milliseconds stop_timeout{2'000}; // for each child; then it is killed, and after as long again left behind
  std::function<void(exit_request)> on_exit_request; // any thread; the process should end in order
};

// What the outside sees of the guardian while it runs.
struct guardian_status {
  std::atomic<std::int64_t> last_tick_ns{0}; // monotonic; 0 = not started
  std::atomic<std::uint32_t> hanging{0};     // incarnations left behind in a handler that does not return
  std::atomic<std::uint64_t> restarts{0};
  std::atomic<bool> has_begun{false}; // each child has been up once, or was given up; stays true
};

// Spawns the guardian; it starts the children when tell_guardian_to_start() says so.
[[nodiscard]] caf::strong_actor_ptr spawn_guardian(caf::actor_system& system, const services& outside,
                                                   std::vector<child_spec> children, guardian_options options,
                                                   decider_handle decider, std::shared_ptr<guardian_status> status);

void tell_guardian_to_start(const caf::strong_actor_ptr& guardian);
void tell_guardian_to_stop(const caf::strong_actor_ptr& guardian);

} // namespace godwit::runtime
