// Tells when a UDP peer that has refused may be taken to listen again, although it says nothing.
//
// A refusal (ICMP, port unreachable) answers something that was sent. So the peer is back when something was sent after
// the last refusal, and `answer_time` has gone by without a new one. Systems send such news once a second at most, so
// a shorter time would see gaps between them as the peer's return; the rest is for a slow line. With a heartbeat each
// second a peer that came back is believed within 4 s. Thread: one at a time. Pure: the clock is the caller's.
// Source: udp(7), icmp(7).
#pragma once

#include <chrono>
#include <optional>

namespace godwit::io::link {

class refusal_watch {
public:
  using time_point = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds answer_time{2'500};

  void refused() { sent_since_refusal_.reset(); }
  void sent(time_point now) {
    if (!sent_since_refusal_)
      sent_since_refusal_ = now;
  }
  [[nodiscard]] bool is_over(time_point now) const {
    return sent_since_refusal_ && now - *sent_since_refusal_ >= answer_time;
  }

private:
  std::optional<time_point> sent_since_refusal_;
};

} // namespace godwit::io::link
