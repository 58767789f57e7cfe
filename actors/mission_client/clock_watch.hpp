// Notices that the wall clock was set while the process runs: it is seen beside a clock that nobody sets.
//
// What happens to the clock between two processes is not seen; retry_policy.hpp says what that does to a window.
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/mission_client/planning_context.hpp"

namespace godwit::mission_client {

// Smaller steps are how time synchronisation works, and change nothing that matters here.
inline constexpr std::int64_t least_jump_ns = second_ns;

class clock_watch {
public:
  // By how much the wall clock was set since the last look; nothing: it was not.
  [[nodiscard]] std::optional<std::int64_t> jump(instant now) {
    const auto apart_ns = now.wall_ns - now.monotonic_ns;
    if (!apart_ns_)
      apart_ns_ = apart_ns;
    const auto by_ns = apart_ns - *apart_ns_;
    if (by_ns <= least_jump_ns && by_ns >= -least_jump_ns)
      return std::nullopt;
    apart_ns_ = apart_ns;
    return by_ns;
  }

private:
  std::optional<std::int64_t> apart_ns_;
};

} // namespace godwit::mission_client
