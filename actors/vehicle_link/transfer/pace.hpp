// How far apart answers lie while all goes well: the pace of the slowest place on the way.
//
// The round trip alone does not tell that something was lost: while a queue is being worked off, each answer takes
// longer than the one before. So a loss is believed only when answers have also stopped coming for longer than they
// usually lie apart. Thread: one at a time.
#pragma once

#include <algorithm>
#include <cstdint>

#include "actors/vehicle_link/transfer/round_trip.hpp"

namespace godwit::vehicle_link::transfer {

class pace {
public:
  // Three times the usual interval is more than its unevenness.
  static constexpr std::int64_t intervals_without_answer = 3;

  // COUNT answers at once.
  void on_answers(int count, std::int64_t now_ns) {
    if (is_running_ && last_ns_ >= stalled_ns_)
      interval_ns_ += ((now_ns - last_ns_) / count - interval_ns_) / 8;
    is_running_ = true;
    last_ns_ = now_ns;
  }

  // Answers had stopped: the next interval says nothing.
  void on_stall(std::int64_t now_ns) { stalled_ns_ = now_ns; }

  // Until then the answers may still be coming; AT_MOST_NS after the last one. Where no queue is worked off that is
  // little: then an answer takes its round trip, however far apart the bursts lie.
  [[nodiscard]] std::int64_t runs_until_ns(std::int64_t at_most_ns) const {
    const auto pause_ns = std::max(round_trip::min_margin_ns, intervals_without_answer * interval_ns_);
    return is_running_ ? last_ns_ + std::min(pause_ns, at_most_ns) : 0;
  }

private:
  bool is_running_ = false;
  std::int64_t last_ns_ = 0;
  std::int64_t stalled_ns_ = 0;
  std::int64_t interval_ns_ = 0; // smoothed
};

// WAIT_NS lengthened by half for each of STEPS, up to LIMIT_NS: how the waits of repeated silence grow.
[[nodiscard]] constexpr std::int64_t lengthened(std::int64_t wait_ns, int steps, std::int64_t limit_ns) {
  for (int i = 0; i < steps && wait_ns < limit_ns; ++i)
    wait_ns = std::min(wait_ns + wait_ns / 2, limit_ns);
  return wait_ns;
}

} // namespace godwit::vehicle_link::transfer
