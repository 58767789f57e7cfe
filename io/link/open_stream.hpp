// A stream of bytes that is open: hands on what it brings, writes what it is given, says when it has ended. Used again
// for the next stream when that one is over.
//
// A send goes to the system in the calling thread as long as nothing waits; what the system does not take goes into a
// bounded queue, and the thread of the link writes it when there is room again. A chunk goes out as a whole or not at
// all.
//
// Errors: hooks.ended, with the system's number. Thread: send and queued_bytes from any; the rest, and the hooks but
// for write, in the link's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <sys/types.h>

#include "io/link/counter_set.hpp"
#include "io/link/descriptor.hpp"
#include "io/link/liveness.hpp"

namespace godwit::io::link {

// What a stream has accepted and the system has not taken yet: bytes in a ring of fixed size, and where each chunk
// ends.
//
// A chunk is taken as a whole or not at all, so that the other side never sees half a frame followed by another.
// Thread: one at a time.
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

class open_stream {
public:
  struct hooks {
    // As write(2), and never raises SIGPIPE. In any thread, under the stream's lock.
    std::function<ssize_t(int stream, std::span<const std::byte> bytes)> write;
    // Before the stream is closed, so that closing it does not wait for what the other side does not take.
    std::function<void(int stream)> discard_output;
    std::function<void(std::span<const std::byte> bytes)> received;
    // ERROR is 0 when the other side has ended it. The stream is closed by then.
    std::function<void(int error)> ended;
  };

  // READ_BUFFER is used during a turn only.
  open_stream(boost::asio::io_context& io, std::span<std::byte> read_buffer, std::size_t queue_bytes,
              counter_set& counters, hooks owner);
  ~open_stream();
  open_stream(const open_stream&) = delete;
  open_stream& operator=(const open_stream&) = delete;

  // Takes STREAM, which does not block, and reads on it.
  [[nodiscard]] boost::system::error_code take(descriptor stream);

  // True: handed to the system or queued as a whole.
  bool send(std::span<const std::byte> bytes);
  [[nodiscard]] std::size_t queued_bytes() const;

private:
  static constexpr int max_reads_a_turn = 16; // then timers and senders have their turn

  // What came of writing until the system takes no more.
  enum class write_end { all_written, system_full, failed };

  void wait_readable();
  void read(std::uint64_t generation);
  void wait_writable();
  void write_queued(std::uint64_t generation);
  [[nodiscard]] write_end write_queue();
  [[nodiscard]] write_end write_some(std::span<const std::byte> bytes, std::size_t& written);
  void wait_writable_soon();
  void fail_soon(int error);
  void lost(int error);

  boost::asio::io_context& io_;
  std::span<std::byte> buffer_;
  counter_set& counters_;
  hooks owner_;

  mutable std::mutex mutex_;    // never held while a callback runs
  int write_descriptor_ = -1;   // the stream's, while it is up
  int write_error_ = 0;         // the last one; why the stream is about to be closed
  bool waits_writable_ = false; // the link's thread writes the queue when there is room
  send_queue queue_;

  boost::asio::posix::stream_descriptor stream_;
  std::uint64_t generation_ = 0; // of the stream: a wait that was over just before it was closed must not count
  liveness alive_;
};

} // namespace godwit::io::link
