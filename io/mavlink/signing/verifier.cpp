#include "io/mavlink/signing/verifier.hpp"

#include <algorithm>

namespace godwit::io::mavlink {

verdict verifier::judge(const frame_view& frame, signing_time now) {
  const verdict found = judge_uncounted(frame, now);
  counts_.count(found);
  return found;
}

verdict verifier::judge_uncounted(const frame_view& frame, signing_time now) {
  if (!frame.is_signed() || !hasher_)
    return policy_.lets_through(frame.id()) ? verdict::accepted_unsigned : verdict::unsigned_refused;
  if (!hasher_->is_right(frame))
    return verdict::bad_signature;
  const signature_block block = signature_of(frame);
  return streams_->take({frame.from(), block.link}, block.time, now);
}

verdict replay_table::take(const signed_stream& stream, signing_time time, signing_time now) {
  if (units(time) > units(now) + max_ahead)
    return verdict::too_new;
  const auto used = std::span(places_).first(count_);
  const auto known = std::ranges::find(used, stream, &place::stream);
  if (known == used.end())
    return take_new(stream, time, now);
  if (time <= known->last)
    return verdict::replayed;
  known->last = time;
  return verdict::accepted_signed;
}

verdict replay_table::take_new(const signed_stream& stream, signing_time time, signing_time now) {
  if (units(time) + max_behind < units(now))
    return verdict::too_old;
  if (forgotten_ > 0 && time <= last_forgotten_)
    return verdict::replayed;
  place* const to = count_ < max_signed_streams ? &places_[count_++] : freed_place(now);
  if (to == nullptr)
    return verdict::too_many_streams;
  *to = {stream, time};
  return verdict::accepted_signed;
}

replay_table::place* replay_table::freed_place(signing_time now) {
  const auto oldest = std::ranges::min_element(places_, {}, &place::last);
  if (units(oldest->last) + max_behind >= units(now))
    return nullptr;
  ++forgotten_;
  last_forgotten_ = std::max(last_forgotten_, oldest->last);
  return &*oldest;
}

} // namespace godwit::io::mavlink
