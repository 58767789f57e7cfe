// Tries to open, tries again, and tells: the part that all links share.
//
//   begin --> connecting --opened--> up --lost--> down --after back-off--> (open, still down) --opened--> up
//                  `------failed----------------^  ^------failed-----------------'
//                                   up --unanswered--> down (still open) --answered--> up      udpout only
//
// A try that follows a failure keeps the phase "down" and its reason: whoever watches sees no flicker. The back-off
// starts anew after the link was up for `stable_after`; a device that opens and dies at once is not tried ten times a
// second. Thread: the link's own.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "io/link/counter_set.hpp"
#include "io/link/link.hpp"
#include "io/link/liveness.hpp"

namespace godwit::io::link {

// How long to wait before the next try: twice as long each time, up to a cap.
//
// Thread: one. Pure: the clock is the caller's.
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

class lifecycle {
public:
  static constexpr std::chrono::seconds stable_after{2};

  // OPEN starts one try, which ends in a call of opened() or failed(), at once or later.
  lifecycle(boost::asio::io_context& io, back_off pause, counter_set& counters,
            std::function<void(const link_status&)> changed, std::function<void()> open);

  void begin(std::string tried);
  void opened(std::string where);
  // A try failed, or what was open is lost and closed.
  void failed(std::string why);
  void unanswered(std::string why);
  void answered(std::string where);

  [[nodiscard]] link_phase phase() const { return status_.phase; }

private:
  using clock = std::chrono::steady_clock;

  void try_now();
  void come_up(std::string where);
  void tell(link_phase phase, std::string reason);

  boost::asio::steady_timer timer_;
  back_off pause_;
  counter_set& counters_;
  std::function<void(const link_status&)> changed_;
  std::function<void()> open_;
  link_status status_;
  bool is_open_ = false;
  bool was_up_ = false;
  clock::time_point try_began_;
  clock::time_point opened_at_;
  liveness alive_;
};

} // namespace godwit::io::link
