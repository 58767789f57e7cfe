// So many frames and bytes a second go on, and no more: what runs over is not passed on, and counted.
//
// A second's worth may come at once. Pure. Times: ns, monotonic. Thread: one at a time.
#pragma once

#include <algorithm>
#include <cstdint>

namespace godwit::ground_port::passing {

class budget {
public:
  struct rate {
    std::int64_t frames_per_s = 0;
    std::int64_t bytes_per_s = 0;
  };

  explicit budget(rate most)
      : most_(most), frames_left_(most.frames_per_s * per_s), bytes_left_(most.bytes_per_s * per_s) {}

  // True: it goes on, and is paid for.
  [[nodiscard]] bool take(std::size_t bytes, std::int64_t now_ns) {
    const auto passed = std::clamp<std::int64_t>(now_ns - last_ns_, 0, per_s);
    last_ns_ = now_ns;
    frames_left_ = std::min(most_.frames_per_s * per_s, frames_left_ + passed * most_.frames_per_s);
    bytes_left_ = std::min(most_.bytes_per_s * per_s, bytes_left_ + passed * most_.bytes_per_s);
    const auto costs = static_cast<std::int64_t>(bytes) * per_s;
    if (frames_left_ < per_s || bytes_left_ < costs) {
      ++dropped_;
      return false;
    }
    frames_left_ -= per_s;
    bytes_left_ -= costs;
    return true;
  }

  [[nodiscard]] std::uint64_t dropped() const { return dropped_; } // frames

private:
  static constexpr std::int64_t per_s = 1'000'000'000; // the unit: a frame, or byte, for one nanosecond

  rate most_;
  std::int64_t frames_left_; // in units
  std::int64_t bytes_left_;  // the same
  std::int64_t last_ns_ = 0;
  std::uint64_t dropped_ = 0;
};

} // namespace godwit::ground_port::passing
