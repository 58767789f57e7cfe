// When a process that goes on without its executor may end, so that the next one begins with one.
//
// In flight nobody ends it a second time: link and failsafe go on. After the landing nobody is there to count it and
// to revive the others, but the heartbeats still say that the vehicle stands disarmed. Pure: time comes in as monotonic
// nanoseconds. Source: HEARTBEAT (0), base_mode.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/supervision/messages.hpp"

namespace godwit::landing_watch {

// Longer than a person takes who disarms and arms again, and than the executor takes to revive others.
inline constexpr std::int64_t stands_ns = 10'000'000'000;
// Three heartbeats of an autopilot, which sends one a second: a vehicle that is not heard may have been armed.
inline constexpr std::int64_t heard_ns = 3'000'000'000;

class core {
public:
  void on_heartbeat(bool is_armed, std::int64_t now_ns);
  // Disarmed for so long, without a gap.
  [[nodiscard]] bool stands(std::int64_t now_ns) const;

private:
  std::optional<std::int64_t> disarmed_ns_; // since then
  std::int64_t last_ns_ = 0;
};

// Nobody will start NAME any more.
[[nodiscard]] bool is_given_up(const runtime::children& all, const std::string& name);

} // namespace godwit::landing_watch
