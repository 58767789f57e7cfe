// What a client has done so far.
//
// Thread: the plain values any; the set is written by the client's thread and by senders, and read by anybody. Two
// counters that are read together may be one event apart.
#pragma once

#include <atomic>
#include <cstdint>

#include "io/link/counter_set.hpp"

namespace godwit::io::http {

// Totals since the client was opened, but for the three marked "now".
struct client_counters {
  std::uint64_t accepted = 0;       // requests that were taken; each ends in one of the next two
  std::uint64_t answered = 0;       // with whatever status
  std::uint64_t failed = 0;         // with an error, cancelled ones included
  std::uint64_t refused = 0;        // requests that were not taken: invalid, too many
  std::uint64_t timed_out = 0;      // of the failed: any of the three time-outs
  std::uint64_t cancelled = 0;      // of the failed
  std::uint64_t connections = 0;    // made, to the service or its proxy
  std::uint64_t connect_errors = 0; // tries to connect that failed
  std::uint64_t reused = 0;         // requests that began on a kept connection
  std::uint64_t repeated = 0;       // of these: sent again, because the connection turned out to be dead
  std::uint64_t request_bytes = 0;  // heads and bodies, handed to the system
  std::uint64_t response_bytes = 0; // heads and bodies, taken from it; without what TLS adds
  std::uint64_t under_way = 0;      // now: with a connection or making one
  std::uint64_t waiting = 0;        // now: for a free connection
  std::uint64_t kept = 0;           // now: connections without a request
  bool operator==(const client_counters&) const = default;
};

struct counter_set {
  link::counter accepted, answered, failed, refused, timed_out, cancelled, connections, connect_errors, reused,
      repeated, request_bytes, response_bytes;
  std::atomic<std::uint64_t> under_way{0};
  std::atomic<std::uint64_t> waiting{0};
  std::atomic<std::uint64_t> kept{0};

  [[nodiscard]] client_counters values() const {
    client_counters all;
    all.accepted = accepted.value();
    all.answered = answered.value();
    all.failed = failed.value();
    all.refused = refused.value();
    all.timed_out = timed_out.value();
    all.cancelled = cancelled.value();
    all.connections = connections.value();
    all.connect_errors = connect_errors.value();
    all.reused = reused.value();
    all.repeated = repeated.value();
    all.request_bytes = request_bytes.value();
    all.response_bytes = response_bytes.value();
    all.under_way = under_way;
    all.waiting = waiting;
    all.kept = kept;
    return all;
  }
};

} // namespace godwit::io::http
