// A signed frame without its signature, as logs are to hold it.
//
// The flag that announces the signature is cleared, and the checksum, which covers the flag, is made to fit. Everything
// else stays as it came, zeros at the end of the payload included. A checksum is linear, so the difference that one
// flag makes is known without CRC_EXTRA: this works for ids that nobody knows, and a checksum that was wrong stays
// wrong. Thread: pure. Source: the MAVLink guide, "Message Signing" (logging).
#pragma once

#include <array>

#include "io/mavlink/frame.hpp"

namespace godwit::io::mavlink {

using unsigned_frame_bytes = std::array<std::byte, max_unsigned_frame_size>;

// FRAME itself if it is not signed, else a copy without its signature in TO, which must live as long as the view.
[[nodiscard]] frame_view strip_signature(const frame_view& frame, unsigned_frame_bytes& to);

} // namespace godwit::io::mavlink
