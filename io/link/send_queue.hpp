// What a stream has accepted and the system has not taken yet: bytes in a ring of fixed size, and where each chunk
// ends.
//
// A chunk is taken as a whole or not at all, so that the other side never sees half a frame followed by another.
// Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

namespace godwit::io::link {

class send_queue {
public:
  explicit send_queue(std::size_t capacity_bytes) : ring_(capacity_bytes) {}

  [[nodiscard]] std::size_t size_bytes() const { return static_cast<std::size_t>(pushed_ - popped_); }
  [[nodiscard]] bool empty() const { return pushed_ == popped_; }
  [[nodiscard]] bool fits(std::size_t bytes) const { return bytes <= ring_.size() - size_bytes(); }

  // The rest of a chunk, or all of it; it must fit and must not be empty.
  void push(std::span<const std::byte> chunk);
  // The bytes to write next, as far as they lie together; empty only when the queue is.
  [[nodiscard]] std::span<const std::byte> front() const;
  // The first BYTES of front() are written; gives the number of chunks that are complete with them.
  std::size_t pop(std::size_t bytes);
  // Throws everything away; gives the number of chunks.
  std::size_t clear();

private:
  std::vector<std::byte> ring_;
  std::deque<std::uint64_t> ends_; // of each chunk, counted as pushed_ is; at most one for each byte of the ring
  std::uint64_t pushed_ = 0;       // bytes since the beginning
  std::uint64_t popped_ = 0;
};

} // namespace godwit::io::link
