// Takes out of the bytes of a line, before they are recorded, what nobody else may have: keys (SETUP_SIGNING) and
// signatures. They become zeros; a frame may lie in several pieces.
//
// A key is found wherever its header stands, also in bytes that are no frame; a signature where the frames before it
// could be followed. Thread: one owner. Source: the MAVLink guide, "Packet Serialization".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/link/status.hpp"
#include "io/mavlink/wire_format.hpp"

namespace godwit::line {

class secret_eraser {
public:
  // The next bytes of PEER. A datagram begins with a frame; a stream goes on where it was.
  void erase(io::link::peer_id peer, bool is_datagram, std::span<std::byte> bytes);

private:
  void take(std::byte& each);
  void begin_frame();

  io::link::peer_id peer_ = 0;
  std::array<std::byte, io::mavlink::header_size> newest_{}; // bytes as they came, the last one last
  std::size_t key_left_ = 0;                                 // bytes of a key to come
  std::size_t header_left_ = 0;                              // 0: no header is being read
  std::size_t frame_left_ = 0;                               // bytes of a frame to come, behind its header
  std::size_t signature_ = 0;                                // so many of these are a signature
};

} // namespace godwit::line
