// Finds the frames in what the stations of one vehicle send: whole datagrams, or streams that tear frames anywhere, a
// scanner for each.
//
// Datagrams leave nothing behind, so all vehicles can share the scanner for these. Streams are bounded: the one that
// was silent for longest is forgotten for a new one. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "io/link/status.hpp"
#include "io/mavlink/scanner.hpp"

namespace godwit::sim {

class frame_finder {
public:
  static constexpr std::size_t max_streams = 16;          // as many peers as a link has
  static constexpr std::int64_t silence_ns = 250'000'000; // then no more bytes belong to the frame that waits for some
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

  explicit frame_finder(io::mavlink::scanner& datagrams) : datagrams_(datagrams) {}

  template <class Sink>
  void feed(io::link::peer_id from, std::span<const std::byte> bytes, bool is_datagram, std::int64_t now_ns,
            Sink&& sink) {
    if (is_datagram) {
      datagrams_.feed_datagram(bytes, sink);
      return;
    }
    auto& stream = stream_of(from);
    stream.heard_ns = now_ns;
    stream.scanner->feed(bytes, sink);
  }

  // Ends what has waited too long.
  template <class Sink>
  void on_time(std::int64_t now_ns, Sink&& sink) {
    for (auto& each : streams_)
      if (each.scanner->waiting_bytes() != 0 && now_ns >= each.heard_ns + silence_ns)
        each.scanner->end_of_datagram(sink);
  }
  [[nodiscard]] std::int64_t next_deadline_ns() const;

  void forget(io::link::peer_id who);
  void forget_all() { streams_.clear(); }

private:
  struct torn_stream {
    io::link::peer_id from;
    std::int64_t heard_ns;
    std::unique_ptr<io::mavlink::scanner> scanner;
  };

  [[nodiscard]] torn_stream& stream_of(io::link::peer_id from);

  io::mavlink::scanner& datagrams_;
  std::vector<torn_stream> streams_;
};

} // namespace godwit::sim
