// A child of the guardian as the composition declares it, why a process should end, and what is seen of the guardian
// from outside. Thread: plain values and atomics.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/actor_frame.hpp"
#include "runtime/supervision/handle.hpp"
#include "runtime/supervision/policy.hpp"

namespace godwit::runtime {

// Makes the actor of an incarnation. May throw: then the incarnation does not come to be.
using actor_maker = std::function<std::unique_ptr<actor_frame>(spawn_context)>;

struct child_spec {
  actor_ref address;
  child_policy policy;
  bool is_durable = false; // has state in the journal
  actor_maker make;
};

// Who hears that children live, and which.
struct liveness_listener {
  liveness_handle who;
  std::vector<std::string> of;
};

enum class exit_cause {
  requested,
  essential_given_up,
  essential_silent,
  no_free_worker,
  guardian_died,
  recovery_overdue,   // the journal does not give back what a child's state is
  given_up_in_flight, // one of these while the table says fast_once: end within fast_end, by force
};

// From the request for a fast end to the end of the process.
inline constexpr milliseconds fast_end{500};

GODWIT_ENUM_NAMES(exit_cause, requested, essential_given_up, essential_silent, no_free_worker, guardian_died,
                  recovery_overdue, given_up_in_flight);

struct exit_request {
  exit_cause cause = exit_cause::requested;
  std::string reason; // a sentence for people
};

// What the outside sees of the guardian while it runs.
struct guardian_status {
  std::atomic<std::int64_t> last_tick_ns{0}; // monotonic; 0 = not started
  std::atomic<std::uint32_t> hanging{0};     // incarnations left behind in a handler that does not return
  std::atomic<std::uint64_t> restarts{0};
  std::atomic<bool> has_begun{false}; // each child has been up once, or was given up; stays true
};

} // namespace godwit::runtime
