#include "io/mavlink/signing/verifier.hpp"

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

} // namespace godwit::io::mavlink
