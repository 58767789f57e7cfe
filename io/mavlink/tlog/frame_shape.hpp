// What stands at a place in a log where a frame may begin, judged from the bytes alone.
//
// Thread: pure. Source: the MAVLink guide, "Packet Serialization".
#pragma once

#include <cstddef>
#include <cstdint>

#include "io/mavlink/wire_format.hpp"

namespace godwit::io::mavlink {

enum class frame_shape : std::uint8_t {
  nothing,       // neither FD nor FE
  cut_off,       // it goes on after the end of the bytes
  unknown_id,    // whole by its length; its checksum can not be verified
  bad_checksum,  // whole by its length
  unknown_flags, // right, with an incompatibility flag that we do not know
  v1,            // right, MAVLink 1
  v2,            // right
};

struct looked_at {
  frame_shape shape = frame_shape::nothing;
  std::size_t size = 0; // of the whole frame, as far as it is known
  // The checksum says that a frame of this size is here.
  [[nodiscard]] bool is_right() const { return shape >= frame_shape::unknown_flags; }
};

// What begins with the first of BYTES, which may reach further than one frame.
[[nodiscard]] looked_at look(byte_view bytes);

} // namespace godwit::io::mavlink
