// MISSION_ITEM_REACHED as PX4 sends it: at once, and then again each second, for the last item that was reached.
// World time. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "programs/godwit-sim/vehicle/autopilot/names.hpp"

namespace godwit::sim {

class repeated_reached {
public:
  static constexpr int max_repetitions = 10;
  static constexpr std::int64_t period_ns = ns_per_s;

  void reach(int sequence, std::int64_t now_ns) {
    sequence_ = sequence;
    left_ = max_repetitions;
    next_ns_ = now_ns + period_ns;
  }
  void forget() { left_ = 0; }
  // Of the plan that is flown; it is not forgotten.
  [[nodiscard]] std::optional<int> last() const { return sequence_; }

  [[nodiscard]] std::int64_t next_ns() const { return left_ > 0 ? next_ns_ : never_ns; }
  // The sequence to tell again, if it is time.
  [[nodiscard]] std::optional<int> due(std::int64_t now_ns) {
    if (now_ns < next_ns())
      return std::nullopt;
    --left_;
    next_ns_ += period_ns;
    return sequence_;
  }

private:
  std::optional<int> sequence_;
  int left_ = 0;
  std::int64_t next_ns_ = 0;
};

} // namespace godwit::sim
