// Finds the frames in what the peers of one link send: what they send does not mix, and each may split frames over
// datagrams. Counters and senders are those of all. Thread: one at a time.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "io/link/status.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::programs {

class peer_scanners {
public:
  static constexpr std::size_t max_peers = 16; // as a UDP link has; the one that spoke first makes room

  template <class Sink>
  void feed(io::link::peer_id peer, bool is_datagram, std::span<const std::byte> bytes, Sink&& sink) {
    auto& from = scanner_of(peer);
    if (is_datagram)
      from.feed_next_datagram(bytes, sink);
    else
      from.feed(bytes, sink);
  }

  // Nothing more belongs to what waits.
  template <class Sink>
  void end_of_datagram(Sink&& sink) {
    for (auto& [peer, each] : scanners_)
      each.end_of_datagram(sink);
  }

  [[nodiscard]] std::size_t waiting_bytes() const;
  [[nodiscard]] io::mavlink::scan_counters counters() const;
  [[nodiscard]] std::vector<io::mavlink::sender_counters> senders() const;

private:
  [[nodiscard]] io::mavlink::scanner& scanner_of(io::link::peer_id peer);

  std::map<io::link::peer_id, io::mavlink::scanner> scanners_;
  io::mavlink::scan_counters forgotten_; // of peers that made room
};

} // namespace godwit::programs
