// Signs the frames that leave on one link.
//
// A frame is signed when it is sent and not before, because its timestamp must be above all that went out; a repetition
// is made and signed anew. The frame comes from `encode(..., signing::on)`, so its checksum covers the signed flag.
// `wall_ns` is nanoseconds since 1970, UTC. Errors: `timestamps_used_up`, see signing_clock.hpp; the frame is unchanged
// then. Thread: one at a time. Source: the MAVLink guide, "Message Signing".
#pragma once

#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"
#include "io/mavlink/signing/signature.hpp"
#include "io/mavlink/signing/signing_clock.hpp"

namespace godwit::io::mavlink {

enum class sign_error { timestamps_used_up };

GODWIT_ENUM_NAMES(sign_error, timestamps_used_up);

class signer {
public:
  // CEILING: what an earlier life has reserved last, see signing_clock.hpp.
  signer(secret_key key, link_id link, signing_time ceiling) : hasher_(std::move(key)), link_(link), clock_(ceiling) {}

  // Appends the signature to a frame that waits for it, and gives the timestamp that it carries.
  [[nodiscard]] tl::expected<signing_time, sign_error> sign(frame_buffer& frame, std::int64_t wall_ns);

  [[nodiscard]] signing_clock& clock() { return clock_; }
  [[nodiscard]] link_id link() const { return link_; }

private:
  frame_hasher hasher_;
  link_id link_;
  signing_clock clock_;
};

} // namespace godwit::io::mavlink
