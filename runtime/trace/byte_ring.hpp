// A ring of bytes between one producing and one consuming thread, without locks.
//
// The memory is mapped twice, one copy after the other, so that what is free and what is readable is always one piece:
// a record never has to be split at the end. Thread: free_space, publish: the producer; readable, consume: the
// consumer.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>

namespace godwit::runtime {

class byte_ring {
public:
  // SIZE is a multiple of the page size and a power of two. Null when the system gives no memory.
  [[nodiscard]] static std::unique_ptr<byte_ring> make(std::size_t size);
  byte_ring(const byte_ring&) = delete;
  byte_ring& operator=(const byte_ring&) = delete;
  ~byte_ring();

  [[nodiscard]] std::span<std::byte> free_space(std::size_t wanted) {
    const auto head = head_.load(std::memory_order_relaxed);
    if (size_ - (head - known_tail_) < wanted)
      known_tail_ = tail_.load(std::memory_order_acquire);
    return {memory_ + (head & (size_ - 1)), size_ - (head - known_tail_)};
  }
  void publish(std::size_t bytes) {
    head_.store(head_.load(std::memory_order_relaxed) + bytes, std::memory_order_release);
  }
  // As the producer last knew it: an upper bound.
  [[nodiscard]] bool more_than_half_full() const {
    return head_.load(std::memory_order_relaxed) - known_tail_ > size_ / 2;
  }

  [[nodiscard]] std::span<const std::byte> readable() const {
    const auto tail = tail_.load(std::memory_order_relaxed);
    return {memory_ + (tail & (size_ - 1)), head_.load(std::memory_order_acquire) - tail};
  }
  void consume(std::size_t bytes) {
    tail_.store(tail_.load(std::memory_order_relaxed) + bytes, std::memory_order_release);
  }

private:
  byte_ring(std::byte* memory, std::size_t size) : memory_(memory), size_(size) {}

  std::byte* const memory_;
  const std::size_t size_;
  // Three cache lines: what the consumer reads, what only the producer uses, what the producer reads.
  alignas(64) std::atomic<std::size_t> head_{0}; // bytes ever published
  alignas(64) std::size_t known_tail_ = 0;       // the producer's copy of tail_
  alignas(64) std::atomic<std::size_t> tail_{0}; // bytes ever consumed
};

} // namespace godwit::runtime
