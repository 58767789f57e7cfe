// The flight recorder of the actors: every delivery, into MCAP files, without making the actors wait.
//
//   actor threads ──encode──> one byte_ring each ──> writer thread ──render JSON──> segments godwit-RUN-N.mcap
//
// record() copies header and encoded message into the ring of its thread. The writer thread renders and writes; what
// was recorded is in the file, and so safe from SIGKILL, after at most the flush interval and the time to render. A
// ring that is full drops the record and counts it; the counts are written into the trace as messages of type
// runtime.trace_loss. Each actor and message type has a channel /ACTOR/TYPE with a JSON Schema. log_time is wall time
// (ns). Thread: record() from any thread; everything else from the owner.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "runtime/clock.hpp"
#include "runtime/directory.hpp"
#include "runtime/health_board.hpp"
#include "runtime/trace/tick_clock.hpp"
#include "runtime/trace/trace_sink.hpp"

namespace godwit::runtime {

struct trace_options {
  std::filesystem::path folder;
  std::uint64_t segment_bytes = std::uint64_t{8} << 20U;
  std::uint64_t total_bytes = std::uint64_t{256} << 20U; // of all segments; the oldest are deleted
  milliseconds flush{100};
  std::uint64_t run = 1; // part of the file names; the journal counts it
  std::string program = "godwit";
  // What else a reader has to know of the run, such as its settings without secrets; in each segment.
  std::map<std::string, std::string> about;
};

struct trace_counts {
  std::uint64_t recorded = 0;  // taken into a ring
  std::uint64_t dropped = 0;   // a ring was full
  std::uint64_t oversize = 0;  // recorded without its message, which was longer than max_payload
  std::uint64_t written = 0;   // in the files
  std::uint64_t unwritten = 0; // lost because the disk refused
};

class ring_trace final : public trace_sink {
public:
  static constexpr std::size_t ring_bytes = std::size_t{1}
                                            << 20U;     // some 8,000 records; a worker fills it in 8 ms at the most
  static constexpr std::size_t max_payload = 64 * 1024; // encoded bytes of one message
  static constexpr std::size_t max_threads = 64;        // rings; records of further threads are dropped and counted

  // Completes the segments of earlier runs, then starts the writer. The error is a sentence that names the folder and
  // what to do. NAMES, TIME and HEALTH must live longer.
  [[nodiscard]] static tl::expected<std::unique_ptr<ring_trace>, std::string>
  open(trace_options options, const directory& names, const time_source& time, health_board& health);

  ~ring_trace() override;

  [[nodiscard]] std::int64_t ticks() const noexcept override { return tick_clock::now(); }
  void record(const trace_entry& entry, const message_type& type, const void* body) noexcept override;

  // Writes all that was recorded so far and ends the last segment.
  void close();
  [[nodiscard]] trace_counts counts() const;

private:
  class writer;
  struct shared;

  explicit ring_trace(std::unique_ptr<shared> state);

  std::unique_ptr<shared> shared_;
  std::unique_ptr<writer> writer_;
};

// A ring of bytes between one producing and one consuming thread, without locks.
//
// The memory is mapped twice, one copy after the other, so that what is free and what is readable is always one piece:
// a record never has to be split at the end. Thread: free_space, publish: the producer; readable, consume: the
// consumer.
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
