// Flies the cases of a drill in worker processes, so that a flight which ends its process, or has no end, is a finding
// of that flight and nothing more.
//
//   runner ── index ──> worker (forked) ── outcome as JSON ──> runner
//
// Each worker flies one case after another; one that is gone is replaced. Thread: one; there must be no other when it
// begins, because it forks.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

#include "programs/godwit-drill/flights/flight_outcome.hpp"

namespace godwit::drill {

struct case_runner_options {
  unsigned jobs = 1;                       // workers
  std::chrono::milliseconds most{120'000}; // for one case, of this machine
};

// FLY is called in a worker, ON_OUTCOME here, in the order in which they end. A case whose worker dies, or that takes
// longer than it may, has an outcome with that flaw and neither name nor group; the index says which it is.
void run_cases(std::size_t count, const case_runner_options& options,
               const std::function<flight_outcome(std::size_t index)>& fly,
               const std::function<void(std::size_t index, flight_outcome outcome)>& on_outcome);

} // namespace godwit::drill
