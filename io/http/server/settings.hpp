// Where a server listens, and what it bears. Every bound ends in an answer or a closed connection, and is counted
// (counters).
//
// The defaults are for strangers on a slow radio: 500 bytes a second are enough, less is taken for a slow-loris attack
// (CWE-770: many connections that are held open by a byte now and then).
// Thread: plain values.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/http/message.hpp"

namespace godwit::io::http {

struct server_settings {
  std::string host = "127.0.0.1"; // a name or an address of this computer
  std::uint16_t port = 0;         // 0: any free one

  std::vector<header> headers = {}; // of each answer, its own too, unless the handler has said them

  std::size_t max_connections = 256;        // more are closed at once
  std::size_t max_requests = 1000;          // in a connection, which then closes
  std::size_t max_head_bytes = 16 * 1024;   // a token of 8 kB, and as much again: 431
  std::size_t max_target_bytes = 2 * 1024;  // 414
  std::size_t max_body_bytes = 1024 * 1024; // 413; a hook may say less for a target

  std::chrono::milliseconds handshake_timeout{10'000};
  std::chrono::milliseconds idle_timeout{75'000};  // between two requests; clients keep theirs for less
  std::chrono::milliseconds head_timeout{10'000};  // the whole head, from its first byte
  std::chrono::milliseconds body_timeout{20'000};  // from the end of that; longer by what min_bytes_per_s allows
  std::size_t min_bytes_per_s = 500;               // of a body, on average
  std::chrono::milliseconds write_timeout{30'000}; // until a piece of an answer (session.hpp, piece_bytes) is taken
  std::chrono::milliseconds close_timeout{1'000};  // for the other side to close too
};

// What a server has done so far: totals since it was made, but for the one marked "now".
//
// Thread: plain values.
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
