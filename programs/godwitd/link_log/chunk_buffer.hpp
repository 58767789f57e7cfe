// What goes over a link, on its way to the thread that writes it down.
//
// Bounded: what does not fit is dropped as a whole and counted, so that a disk that stands still holds no link up. Its
// memory is taken at the beginning, so that put() never waits for any. Thread: put from any, take by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "io/link/status.hpp"

namespace godwit::daemon {

struct link_chunk {
  std::uint64_t time_us = 0; // since 1970, UTC
  io::link::peer_id peer = 0;
  bool is_sent = false; // by us
  bool is_datagram = false;
  std::size_t size_bytes = 0;
};

// The bytes of all chunks stand one behind the other.
struct link_batch {
  std::vector<link_chunk> chunks;
  std::vector<std::byte> bytes;
};

class chunk_buffer {
public:
  static constexpr std::size_t max_waiting_bytes = std::size_t{1} << 20U; // 40 s of a PX4 at its fastest streams
  static constexpr std::size_t max_waiting_chunks = 16'384;

  chunk_buffer() { reserve(waiting_); }

  // False: dropped.
  bool put(link_chunk chunk, std::span<const std::byte> bytes) {
    chunk.size_bytes = bytes.size();
    const std::lock_guard guard(mutex_);
    if (waiting_.chunks.size() == max_waiting_chunks || waiting_.bytes.size() + bytes.size() > max_waiting_bytes) {
      ++dropped_;
      return false;
    }
    waiting_.chunks.push_back(chunk);
    waiting_.bytes.insert(waiting_.bytes.end(), bytes.begin(), bytes.end());
    return true;
  }

  // All that waits, in its order, in place of what TO held. The memory of TO is used for what comes next.
  void take(link_batch& to) {
    to.chunks.clear();
    to.bytes.clear();
    reserve(to);
    const std::lock_guard guard(mutex_);
    std::swap(waiting_, to);
  }

  [[nodiscard]] std::uint64_t dropped() const { // chunks
    const std::lock_guard guard(mutex_);
    return dropped_;
  }

private:
  static void reserve(link_batch& to) {
    to.chunks.reserve(max_waiting_chunks);
    to.bytes.reserve(max_waiting_bytes);
  }

  mutable std::mutex mutex_;
  link_batch waiting_;
  std::uint64_t dropped_ = 0;
};

} // namespace godwit::daemon
