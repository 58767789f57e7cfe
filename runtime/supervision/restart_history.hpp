// How often a child crashed lately, and what that means: again at once, again after a wait, or no more.
// Thread: one owner.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "runtime/random.hpp"
#include "runtime/supervision/policy.hpp"

namespace godwit::runtime {

class restart_history {
public:
  // The wait before the restart in nanoseconds, or nothing: the child is given up.
  [[nodiscard]] std::optional<std::int64_t> on_crash(const restart_policy& policy, std::int64_t now_ns,
                                                     random_source& random);
  void forget() { crashes_.clear(); }

private:
  std::deque<std::int64_t> crashes_; // times in the period, oldest first; at most intensity + 1
};

} // namespace godwit::runtime
