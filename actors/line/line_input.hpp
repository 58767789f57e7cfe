// What a line gave its actor, in the form in which the trace has it: a change of the line's state, or bytes that came
// in. A replay hands it to the actor again. Thread: values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/fields/field_table.hpp"
#include "io/link/rx_queue.hpp"
#include "io/link/status.hpp"
#include "io/mavlink/wire_format.hpp"

namespace godwit::line {

using line_news = std::variant<io::link::link_status, io::link::arrival>;

struct line_input {
  bool is_status = false; // the next three; else the last three
  io::link::link_phase phase = io::link::link_phase::connecting;
  std::string reason;
  std::uint64_t reconnects = 0;
  io::link::peer_id peer = 0;
  bool is_datagram = false;
  std::string bytes; // hexadecimal digits
  GODWIT_FIELDS(line_input, "line.input", is_status, phase, reason, reconnects, peer, is_datagram, bytes);

  [[nodiscard]] static line_input of(const line_news& news);
  [[nodiscard]] line_news news() const;
};

// What a line has dropped so far, in bytes and frames.
struct line_drops {
  std::uint64_t in = 0;
  std::uint64_t out = 0;
  GODWIT_FIELDS(line_drops, "line.drops", in, out);
};

// Takes out of the bytes of a line, before they are recorded, what nobody else may have: keys (SETUP_SIGNING) and
// signatures. They become zeros; a frame may lie in several pieces.
//
// A key is found wherever its header stands, also in bytes that are no frame; a signature where the frames before it
// could be followed. Thread: one owner. Source: the MAVLink guide, "Packet Serialization".
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
