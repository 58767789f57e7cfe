// Where a server listens, and what it bears. Every bound ends in an answer or a closed connection, and is counted
// (counters.hpp).
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

} // namespace godwit::io::http
