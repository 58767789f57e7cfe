// What a server has done so far: totals since it was made, but for the one marked "now".
//
// Thread: plain values.
#pragma once

#include <cstdint>

namespace godwit::io::http {

struct server_counters {
  std::uint64_t accepted = 0;    // connections
  std::uint64_t turned_away = 0; // connections above their bound, closed at once
  std::uint64_t open = 0;        // now
  std::uint64_t handshakes = 0;  // of TLS that went well
  std::uint64_t upgraded = 0;    // connections that somebody else has taken over
  std::uint64_t requests = 0;    // that were brought to the handler
  std::uint64_t answered = 0;    // of these: the whole answer went out

  // Refused with an answer, by which the connection ends.
  std::uint64_t malformed = 0;      // 400
  std::uint64_t head_too_large = 0; // 431 and 414
  std::uint64_t body_too_large = 0; // 413

  // Connections that were closed or lost.
  std::uint64_t handshakes_failed = 0;
  std::uint64_t handshake_timeouts = 0;
  std::uint64_t idle_timeouts = 0;
  std::uint64_t head_timeouts = 0;
  std::uint64_t body_timeouts = 0;
  std::uint64_t write_timeouts = 0;
  std::uint64_t aborted = 0; // reset by the handler, or because it gave no answer
  std::uint64_t lost = 0;    // the client went in the middle of a request, or before it had its answer
};

} // namespace godwit::io::http
