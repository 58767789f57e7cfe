#include "io/mavlink/scanner.hpp"

#include <cassert>

#include "io/mavlink/crc.hpp"
#include "io/mavlink/ids.hpp"

namespace godwit::io::mavlink {

namespace {

// Some senders cut the extensions off in MAVLink 1, some do not. Zeros at the end are always there.
bool fits_v1(const message_info* info, std::uint8_t length) {
  return info != nullptr && length >= info->base_length && length <= info->full_length;
}

bool has_unknown_flag(const frame_view& frame) { return (frame.incompat() & ~incompat_signed) != 0; }

// True if a good frame lies wholly within the payload of UNKNOWN, or if looking for one took too long.
bool may_hold_good_frame(const frame_view& unknown) {
  // A real frame hardly ever holds what looks like the header of another, and this bounds what a flood of such costs.
  // Giving up loses nothing: the search then goes on byte by byte.
  constexpr int max_checksums = 4;
  int checksums = 0;
  const std::byte* const end = unknown.bytes().data() + unknown.size();
  for (const std::byte* at = unknown.bytes().data() + 1; end - at >= static_cast<std::ptrdiff_t>(min_frame_size);
       ++at) {
    if (*at != magic_v2 || static_cast<std::ptrdiff_t>(frame_size(at)) > end - at)
      continue;
    const frame_view inner(at);
    const auto* const info = find_message(inner.id());
    if (info == nullptr || has_unknown_flag(inner))
      continue;
    if (crc_matches(inner, info->crc_extra) || ++checksums == max_checksums)
      return true;
  }
  return false;
}

} // namespace

bool begins_with_whole_frame(byte_view bytes) {
  if (bytes.size() < min_frame_size || bytes.front() != magic_v2 || frame_size(bytes.data()) > bytes.size())
    return false;
  const frame_view frame(bytes.data());
  const auto* const info = find_message(frame.id());
  return info != nullptr && crc_matches(frame, info->crc_extra);
}

std::optional<frame_view> scanner::next(search& each) {
  while (each.at < each.stop) {
    std::size_t size = 0;
    verdict found = verdict::garbage;
    if (*each.at == magic_v2)
      found = judge_v2(each, size);
    else if (*each.at == magic_v1)
      found = judge_v1(each, size);
    if (found == verdict::frame) {
      const frame_view frame(each.at);
      each.at += size;
      return frame;
    }
    if (found == verdict::pass_over) {
      each.at += size;
      continue;
    }
    if (found == verdict::wait) {
      if (!each.is_all)
        return std::nullopt;
      counters_.cut_off += each.cut_off_seen ? 0 : 1;
      each.cut_off_seen = true;
    }
    ++counters_.garbage_bytes;
    ++each.at;
  }
  return std::nullopt;
}

scanner::verdict scanner::judge_v2(const search& each, std::size_t& size) {
  const auto left = static_cast<std::size_t>(each.end - each.at);
  if (left < min_frame_size)
    return verdict::wait;
  const frame_view frame(each.at);
  const auto* const info = find_message(frame.id());
  if (info == nullptr && has_unknown_flag(frame))
    return verdict::garbage; // at once: waiting for so unlikely a frame would hold back what follows
  size = frame.size();
  if (left < size)
    return verdict::wait;
  if (info == nullptr)
    return judge_unknown(frame, {each.at + size, each.end}, each.is_all);
  auto& kind = counters_.kinds[slot_of(*info)];
  if (!crc_matches(frame, info->crc_extra)) {
    ++counters_.bad_crc;
    ++kind.bad_crc;
    return verdict::garbage;
  }
  senders_.note(frame.from(), frame.sequence());
  if (has_unknown_flag(frame)) {
    ++counters_.unknown_flag;
    return verdict::pass_over;
  }
  ++counters_.frames;
  ++kind.received;
  return verdict::frame;
}

// The checksum of an unknown id says nothing, so what lies in it and after it must.
scanner::verdict scanner::judge_unknown(const frame_view& frame, byte_view behind, bool is_all) {
  if (behind.size() < header_size && !is_all)
    return verdict::wait;
  if (!(behind.empty() || looks_like_frame(behind)) || may_hold_good_frame(frame))
    return verdict::garbage;
  ++counters_.unknown_id;
  senders_.note_unverified(frame.from(), frame.sequence());
  return verdict::pass_over;
}

// One byte, FD or FE, would be too little to tell: it fits one time in a hundred in the middle of a good frame.
bool scanner::looks_like_frame(byte_view bytes) const {
  if (bytes.size() < header_size)
    return false;
  if (bytes.front() == magic_v2) {
    const frame_view frame(bytes.data());
    return !has_unknown_flag(frame) && senders_.knows(frame.from());
  }
  return bytes.front() == magic_v1 && fits_v1(find_message(byte_at(bytes.data(), 5)), byte_at(bytes.data(), 1)) &&
         senders_.knows({byte_at(bytes.data(), 3), byte_at(bytes.data(), 4)});
}

bool scanner::is_unknown_frame_carried() const {
  if (carried_ < min_frame_size || carry_.front() != magic_v2)
    return false;
  const frame_view frame(carry_.data());
  return frame.size() == carried_ && find_message(frame.id()) == nullptr;
}

// Only what has the id, a fitting length and the checksum of a known message is a MAVLink 1 frame: FE is a common byte,
// and what it seems to begin may hold a real frame.
scanner::verdict scanner::judge_v1(const search& each, std::size_t& size) {
  const auto left = static_cast<std::size_t>(each.end - each.at);
  if (left < header_size_v1)
    return verdict::wait;
  const std::uint8_t length = byte_at(each.at, 1);
  const auto* const info = find_message(byte_at(each.at, 5));
  if (!fits_v1(info, length))
    return verdict::garbage;
  const auto covered = header_size_v1 - 1 + length;
  size = 1 + covered + crc_size;
  if (left < size)
    return verdict::wait;
  std::uint16_t received = 0;
  std::memcpy(&received, each.at + 1 + covered, sizeof received);
  if (frame_crc({each.at + 1, covered}, info->crc_extra) != received) {
    ++counters_.bad_crc;
    ++counters_.kinds[slot_of(*info)].bad_crc;
    return verdict::garbage;
  }
  ++counters_.v1_frames;
  senders_.note({byte_at(each.at, 3), byte_at(each.at, 4)}, byte_at(each.at, 2));
  return verdict::pass_over;
}

void scanner::keep(const std::byte* begin, const std::byte* end) {
  carried_ = static_cast<std::size_t>(end - begin);
  assert(carried_ <= max_carried);
  std::memmove(carry_.data(), begin, carried_);
}

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
  if (used_ == max_senders)
    return;
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
