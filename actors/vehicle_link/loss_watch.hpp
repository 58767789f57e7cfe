// How much of what the vehicle sends is lost on its way, by the gaps in the numbers of its frames.
//
// Looked at over window after window of 10 s, so that a burst is not forgotten at once and an old one is. Pure. Times:
// monotonic nanoseconds. Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>

namespace godwit::vehicle_link {

class loss_watch {
public:
  static constexpr std::int64_t window_ns = 10'000'000'000;
  static constexpr std::uint64_t bad_percent = 10; // a mission transfer is slower then, and commands are repeated
  static constexpr std::uint64_t least_lost = 20;  // frames: fewer say nothing

  [[nodiscard]] bool is_due(std::int64_t now_ns) const { return now_ns - began_ns_ >= window_ns; }
  // Both count from the start on, or anew where the vehicle is heard by another address.
  void look(std::uint64_t received, std::uint64_t lost, std::int64_t now_ns) {
    if (received < received_ || lost < lost_)
      is_known_ = false;
    const auto gone = lost - lost_;
    const auto all = gone + received - received_;
    percent_ = is_known_ && gone >= least_lost ? gone * 100 / all : 0;
    is_known_ = true;
    began_ns_ = now_ns;
    received_ = received;
    lost_ = lost;
  }

  [[nodiscard]] bool is_bad() const { return percent_ >= bad_percent; }
  [[nodiscard]] std::string sentence() const {
    return std::to_string(percent_) + " % of the vehicle's frames are lost (gaps in their sequence numbers); check the "
                                      "radio, the cable and the speed of the line";
  }

private:
  std::int64_t began_ns_ = 0;
  std::uint64_t received_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t percent_ = 0;
  bool is_known_ = false;
};

} // namespace godwit::vehicle_link
