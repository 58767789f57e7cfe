// Which item of a plan is to be sent when: the windowed upload without the protocol around it.
//
//        taken by the vehicle   wanted    under way        not sent yet
//   0 ........................ | k      k+1 ... next-1 | next ......... n-1
//                                <---- window ---->
//
// PX4 and ArduPilot take items in order, whether or not the request for an item has come back. So a request for k says
// that all before k has been taken, as an acknowledgement in TCP does; a lost request costs nothing when a later one
// arrives. An item that was lost makes the vehicle drop all that come after it (PX4 silently, ArduPilot with
// INVALID_SEQUENCE for each), and no request goes beyond it. That shows as silence: item k is overdue when no request
// has come for a usual round trip since it was sent, nor since the last progress for longer than requests usually lie
// apart. Then all from k on is sent again, in a window that fits the measured loss and is at least the item that is
// asked for and the next. On a line that loses much, what was sent together is answered together before more follows:
// PX4 says nothing of what comes after a gap, so each item sent there is wasted. The third silence in a row and each
// further one makes the waits longer by half, up to the period in which the vehicle asks again by itself.
//
// With a window of 1 this is the request by request exchange of the MAVLink text, with a resend on its own round trip.
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "actors/vehicle_link/transfer/go_ahead_window.hpp"
#include "actors/vehicle_link/transfer/pace.hpp"
#include "actors/vehicle_link/transfer/peer_profile.hpp"
#include "actors/vehicle_link/transfer/round_trip.hpp"

namespace godwit::vehicle_link::transfer {

class item_flow {
public:
  // The slowest at which items are sent again.
  static constexpr std::int64_t max_wait_ns = 1'000'000'000;

  // COUNT items, at least one. LINE outlives it.
  item_flow(int count, const peer_profile& peer, round_trip& line);

  // The vehicle begins with item 0 again.
  void restart();

  // The next item that may be sent at NOW, and counts as sent. Nothing: the window is full, or all is sent.
  [[nodiscard]] std::optional<int> take_sendable(std::int64_t now_ns);

  // The vehicle asks for item K, 0 <= K < count. True: it has taken more than was known.
  bool on_request(int k, std::int64_t now_ns);

  // The vehicle had another item than the wanted one, which is a sign that this may be lost. All from it on is sent
  // again if it has had the time for an answer, and has not been sent again since the last progress: what is sent
  // again in vain causes the same sign.
  void on_wrong_item(std::int64_t now_ns);

  // No answer was heard until due_ns(): all from the wanted item on is sent again.
  void on_silence(std::int64_t now_ns);

  // The same, for a reason that says nothing about the line.
  void go_back(std::int64_t now_ns);

  [[nodiscard]] std::int64_t due_ns() const;

  [[nodiscard]] int wanted() const { return wanted_; }
  [[nodiscard]] bool is_all_sent() const { return sent_until_ == count_; } // each at least once
  // An acknowledgement of the last item can have come by now.
  [[nodiscard]] bool may_be_acknowledged(std::int64_t now_ns) const {
    return is_all_sent() && !line_.is_too_soon(now_ns - all_sent_ns_);
  }
  [[nodiscard]] bool is_last_asked_for() const { return wanted_ == count_ - 1; }
  [[nodiscard]] int silences() const { return silences_; } // in a row, without progress
  [[nodiscard]] std::uint32_t sends() const { return sends_; }
  [[nodiscard]] std::uint32_t resends() const { return resends_; }

private:
  struct sending {
    std::int64_t last_ns = 0;
    std::int64_t before_ns = 0; // the last but one
    int times = 0;
  };

  [[nodiscard]] bool awaits_answers() const;
  [[nodiscard]] std::int64_t wait_ns() const;
  void go_back_if_lost(std::int64_t now_ns);
  bool take_sample(const sending& answered, std::int64_t now_ns);

  int count_;
  round_trip& line_;
  go_ahead_window window_;
  pace requests_;
  std::vector<sending> sendings_; // by item
  int wanted_ = 0;
  int next_ = 0;
  int sent_until_ = 0;
  std::int64_t all_sent_ns_ = 0; // for the first time
  int probe_until_ = 0;
  std::optional<int> older_request_; // since the last progress: the vehicle may have begun again
  std::int64_t went_back_ns_ = 0;
  bool has_gone_back_ = false; // since the last progress
  int silences_ = 0;
  int lengthening_ = 0; // of the waits, in steps of half
  std::uint32_t sends_ = 0;
  std::uint32_t resends_ = 0;
};

} // namespace godwit::vehicle_link::transfer
