#include "io/mavlink/signing/signer.hpp"

namespace godwit::io::mavlink {

tl::expected<signing_time, sign_error> signer::sign(frame_buffer& frame, std::int64_t wall_ns) {
  const auto time = clock_.next(wall_ns);
  if (!time)
    return tl::make_unexpected(sign_error::timestamps_used_up);
  frame.append_signature(store({link_, *time, hasher_.hash_of(frame.span(), link_, *time)}));
  return *time;
}

} // namespace godwit::io::mavlink
