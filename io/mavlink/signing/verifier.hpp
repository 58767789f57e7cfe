// Judges the frames that arrive on one link: whether each is signed as it must be, and new.
//
//   signed?  no  -> the link's policy for unsigned frames
//            yes -> signature first, and only if it is right the time, with the rules of replay_table.hpp
//
// The frame was checked by the scanner. A link without a key is trusted: everything is accepted there, and a signature
// is not looked at. The links that share a key share a replay table, which belongs to their owner and outlives them:
// else a frame that was recorded on one could be sent again on another. Links with another key have another table, as
// the holder of one key must not touch the streams of the other. `now` is our own time: signing_clock::now where we
// sign too, else signing_time_at the wall clock. Thread: one at a time. Source: the MAVLink guide, "Message Signing".
#pragma once

#include <optional>

#include "io/mavlink/signing/link_policy.hpp"
#include "io/mavlink/signing/replay_table.hpp"

namespace godwit::io::mavlink {

class verifier {
public:
  // A trusted link.
  verifier() : policy_(unsigned_policy::accept_all()) {}
  // A link whose frames are signed with KEY.
  verifier(secret_key key, replay_table& streams, const unsigned_policy& policy = unsigned_policy())
      : hasher_(std::in_place, std::move(key)), streams_(&streams), policy_(policy) {}

  [[nodiscard]] verdict judge(const frame_view& frame, signing_time now);

  [[nodiscard]] bool has_key() const { return hasher_.has_value(); }
  [[nodiscard]] const verdict_counts& counts() const { return counts_; }

private:
  [[nodiscard]] verdict judge_uncounted(const frame_view& frame, signing_time now);

  std::optional<frame_hasher> hasher_;
  replay_table* streams_ = nullptr; // there is one if there is a key
  unsigned_policy policy_;
  verdict_counts counts_;
};

} // namespace godwit::io::mavlink
