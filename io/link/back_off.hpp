// How long to wait before the next try: twice as long each time, up to a cap.
//
// Thread: one. Pure: the clock is the caller's.
#pragma once

#include <algorithm>
#include <chrono>

namespace godwit::io::link {

class back_off {
public:
  back_off(std::chrono::milliseconds first, std::chrono::milliseconds cap) : first_(first), cap_(cap), next_(first) {}

  [[nodiscard]] std::chrono::milliseconds next() {
    const auto now = next_;
    next_ = std::min(cap_, 2 * next_);
    return now;
  }
  void reset() { next_ = first_; }

private:
  std::chrono::milliseconds first_;
  std::chrono::milliseconds cap_;
  std::chrono::milliseconds next_;
};

} // namespace godwit::io::link
