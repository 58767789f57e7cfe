// What a link's thread hears, on its way to the thread that prints.
//
// Bounded: what does not fit is dropped and counted, so that a terminal that stands still costs no memory. The status
// of the link comes through the same queue, so that it stands between the bytes where it belongs. A descriptor becomes
// readable when there is something to take. Errors: the constructor throws if the system has no descriptor left.
// Thread: push from any, take by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "io/link/link.hpp"

namespace godwit::trace_tool {

struct heard_chunk {
  std::uint64_t time_us = 0; // since 1970, UTC, when it came
  bool is_datagram = false;
  std::vector<std::byte> bytes;
  std::optional<io::link::link_status> status; // then there are no bytes
  io::link::peer_id peer = io::link::only_peer;
};

class chunk_queue {
public:
  static constexpr std::size_t max_waiting_bytes = std::size_t{4} << 20; // a quarter of a minute of a busy link
  static constexpr std::size_t max_waiting_chunks = 65'536;

  chunk_queue();
  ~chunk_queue();
  chunk_queue(const chunk_queue&) = delete;
  chunk_queue& operator=(const chunk_queue&) = delete;

  void push(heard_chunk chunk);
  // All that waits, in its order.
  [[nodiscard]] std::vector<heard_chunk> take();

  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] std::uint64_t dropped_bytes() const;

private:
  mutable std::mutex mutex_;
  std::vector<heard_chunk> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::uint64_t dropped_bytes_ = 0;
  int descriptor_;
};

} // namespace godwit::trace_tool
