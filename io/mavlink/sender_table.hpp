// Which components speak on a link, and how many of their frames did not arrive.
//
// Each component numbers its frames on a link from 0 to 255 and around. A gap is the number of frames that are missing
// in between. A step of more than half the circle is taken as a frame that comes late or twice; two in a row, as a peer
// that began to count anew. A frame that is not believed is taken back. Source: the MAVLink guide, "Packet loss".
// Thread: a value.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "io/mavlink/frame.hpp"

namespace godwit::io::mavlink {

struct sender_counters {
  sender who;
  std::uint8_t last_sequence = 0;
  std::uint8_t behind_in_a_row = 0;
  std::uint64_t received = 0;
  std::uint64_t lost = 0;
  std::uint64_t out_of_order = 0; // late or twice
};

class sender_table {
public:
  // A link has a handful of components. Who comes when the table is full is heard all the same, but not followed.
  static constexpr std::size_t max_senders = 32;

  void note(sender who, std::uint8_t sequence) {
    if (last_ < used_ && senders_[last_].who == who) {
      before_ = senders_[last_];
      count(senders_[last_], sequence);
    } else {
      note_other(who, sequence);
    }
  }
  // The frame that was noted last is not believed: nothing of it counts.
  void take_back();

  // The same for a frame that could not be verified: it does not make a sender known.
  void note_unverified(sender who, std::uint8_t sequence);

  [[nodiscard]] bool knows(sender who) const {
    return std::ranges::any_of(all(), [&](const sender_counters& each) { return each.who == who; });
  }
  [[nodiscard]] std::span<const sender_counters> all() const { return std::span(senders_).first(used_); }
  [[nodiscard]] std::uint64_t not_followed() const { return not_followed_; } // frames

private:
  static void count(sender_counters& each, std::uint8_t sequence);
  void note_other(sender who, std::uint8_t sequence);
  [[nodiscard]] sender_counters* find(sender who);

  std::array<sender_counters, max_senders> senders_{};
  std::size_t used_ = 0;
  std::size_t last_ = 0;                  // who spoke last probably speaks again
  std::optional<sender_counters> before_; // that one, before its last frame; none: it was not known
  std::uint64_t not_followed_ = 0;
};

} // namespace godwit::io::mavlink
