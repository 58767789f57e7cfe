// What a line gave its actor, in the form in which the trace has it: a change of the line's state, or bytes that came
// in. A replay hands it to the actor again. Thread: values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "io/fields/field_table.hpp"
#include "io/link/rx_queue.hpp"
#include "io/link/status.hpp"

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

} // namespace godwit::line
