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
#include <vector>

#include "io/link/status.hpp"
#include "io/mavlink/wire_format.hpp"

namespace godwit::line {

class secret_eraser {
public:
  static constexpr std::size_t max_peers = 16; // as many as a link remembers; the one that spoke first makes room

  // The next bytes of PEER. It goes on where it was, a datagram too, but for one that begins with a whole frame.
  void erase(io::link::peer_id peer, bool is_datagram, std::span<std::byte> bytes);

private:
  struct followed {
    io::link::peer_id peer = 0;
    std::array<std::byte, io::mavlink::header_size> newest{}; // bytes as they came, the last one last
    std::size_t key_left = 0;                                 // bytes of a key to come
    std::size_t header_left = 0;                              // 0: no header is being read
    std::size_t frame_left = 0;                               // bytes of a frame to come, after its header
    std::size_t signature = 0;                                // so many of these are a signature
  };

  [[nodiscard]] followed& find(io::link::peer_id peer);
  static void take(followed& in, std::byte& each);
  static void begin_frame(followed& in);

  std::vector<followed> peers_;
};

} // namespace godwit::line
