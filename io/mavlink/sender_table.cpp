#include "io/mavlink/sender_table.hpp"

namespace godwit::io::mavlink {

void sender_table::count(sender_counters& each, std::uint8_t sequence) {
  constexpr std::uint8_t half_circle = 128;
  constexpr std::uint8_t restart_after = 2; // frames with earlier numbers in a row: the peer began to count anew
  const auto gap = static_cast<std::uint8_t>(sequence - each.last_sequence - 1);
  ++each.received;
  if (gap < half_circle) {
    each.lost += gap;
    each.behind_in_a_row = 0;
  } else {
    ++each.out_of_order;
    if (++each.behind_in_a_row < restart_after)
      return;
    each.behind_in_a_row = 0;
  }
  each.last_sequence = sequence;
}

void sender_table::note_unverified(sender who, std::uint8_t sequence) {
  if (auto* const known = find(who))
    count(*known, sequence);
}

void sender_table::note_other(sender who, std::uint8_t sequence) {
  if (auto* const known = find(who)) {
    before_ = *known;
    count(*known, sequence);
    return;
  }
  before_.reset();
  last_ = used_;
  if (used_ == max_senders) {
    ++not_followed_;
    return;
  }
  senders_[used_++] = {who, sequence, 0, 1, 0, 0};
}

void sender_table::take_back() {
  if (last_ == used_)
    return;
  if (before_)
    senders_[last_] = *before_;
  else
    last_ = --used_;
}

sender_counters* sender_table::find(sender who) {
  for (std::size_t i = 0; i < used_; ++i)
    if (senders_[i].who == who) {
      last_ = i;
      return &senders_[i];
    }
  return nullptr;
}

} // namespace godwit::io::mavlink
