#include "io/link/open_stream.hpp"

#include <algorithm>
#include <cerrno>

#include <boost/asio/post.hpp>
#include <unistd.h>

namespace godwit::io::link {

open_stream::open_stream(boost::asio::io_context& io, std::span<std::byte> read_buffer, std::size_t queue_bytes,
                         counter_set& counters, hooks owner)
    : io_(io), buffer_(read_buffer), counters_(counters), owner_(std::move(owner)), queue_(queue_bytes), stream_(io) {}

open_stream::~open_stream() {
  if (stream_.is_open())
    owner_.discard_output(stream_.native_handle());
}

boost::system::error_code open_stream::take(descriptor stream) {
  boost::system::error_code error;
  stream_.assign(stream.number(), error);
  if (error)
    return error;
  static_cast<void>(stream.release()); // stream_ owns it now
  ++generation_;
  {
    const std::lock_guard lock(mutex_);
    write_descriptor_ = stream_.native_handle();
    write_error_ = 0;
    waits_writable_ = false;
  }
  wait_readable();
  return {};
}

void open_stream::wait_readable() {
  stream_.async_wait(boost::asio::posix::stream_descriptor::wait_read,
                     alive_.guard([this, generation = generation_](const boost::system::error_code& cancelled) {
                       if (!cancelled && generation == generation_)
                         read(generation);
                     }));
}

void open_stream::read(std::uint64_t generation) {
  for (int n = 0; n < max_reads_a_turn; ++n) {
    const ssize_t size = ::read(stream_.native_handle(), buffer_.data(), buffer_.size());
    if (size < 0 && errno == EINTR)
      continue;
    if (size < 0 && errno == EAGAIN)
      break;
    if (size <= 0)
      return lost(size == 0 ? 0 : errno);
    const auto bytes = buffer_.first(static_cast<std::size_t>(size));
    counters_.received(bytes.size());
    owner_.received(bytes);
  }
  if (generation == generation_)
    wait_readable();
}

void open_stream::wait_writable() {
  stream_.async_wait(boost::asio::posix::stream_descriptor::wait_write,
                     alive_.guard([this, generation = generation_](const boost::system::error_code& cancelled) {
                       if (!cancelled && generation == generation_)
                         write_queued(generation);
                     }));
}

void open_stream::write_queued(std::uint64_t generation) {
  if (generation != generation_)
    return;
  auto end = write_end::failed;
  int error = 0;
  {
    const std::lock_guard lock(mutex_);
    end = write_queue();
    error = write_error_;
    waits_writable_ = end == write_end::system_full;
  }
  if (end == write_end::system_full)
    wait_writable();
  else if (end == write_end::failed)
    lost(error);
}

// Under the lock.
open_stream::write_end open_stream::write_queue() {
  while (!queue_.empty()) {
    std::size_t written = 0;
    const auto end = write_some(queue_.front(), written);
    counters_.tx_chunks.add(queue_.pop(written));
    if (end != write_end::all_written)
      return end;
  }
  return write_end::all_written;
}

// Under the lock. WRITTEN is set in every case.
open_stream::write_end open_stream::write_some(std::span<const std::byte> bytes, std::size_t& written) {
  written = 0;
  while (written < bytes.size()) {
    const ssize_t size = owner_.write(write_descriptor_, bytes.subspan(written));
    if (size < 0 && errno == EINTR)
      continue;
    if (size == 0 || (size < 0 && errno == EAGAIN))
      return write_end::system_full;
    if (size < 0) {
      write_error_ = errno;
      return write_end::failed;
    }
    written += static_cast<std::size_t>(size);
    counters_.tx_bytes.add(static_cast<std::uint64_t>(size));
  }
  return write_end::all_written;
}

bool open_stream::send(std::span<const std::byte> bytes) {
  const std::lock_guard lock(mutex_);
  if (write_descriptor_ < 0 || !queue_.fits(bytes.size())) {
    counters_.tx_dropped.add();
    return false;
  }
  std::size_t written = 0;
  auto end = write_end::system_full;
  if (queue_.empty())
    end = write_some(bytes, written);
  if (end == write_end::failed) {
    counters_.tx_dropped.add();
    fail_soon(write_error_);
    return false;
  }
  if (end == write_end::all_written) {
    counters_.tx_chunks.add();
    return true;
  }
  queue_.push(bytes.subspan(written));
  wait_writable_soon();
  return true;
}

// Under the lock, by a sender.
void open_stream::wait_writable_soon() {
  if (waits_writable_)
    return;
  waits_writable_ = true;
  boost::asio::post(io_, alive_.guard([this] {
    if (stream_.is_open())
      wait_writable();
  }));
}

// Under the lock, by a sender. Closing is for the link's own thread, which may have found out by reading, too.
void open_stream::fail_soon(int error) {
  write_descriptor_ = -1;
  boost::asio::post(io_, alive_.guard([this, error] {
    if (stream_.is_open())
      lost(error);
  }));
}

void open_stream::lost(int error) {
  ++generation_;
  counters_.errors.add(error == 0 ? 0 : 1);
  {
    const std::lock_guard lock(mutex_);
    write_descriptor_ = -1;
    waits_writable_ = false;
    counters_.tx_dropped.add(queue_.clear());
  }
  owner_.discard_output(stream_.native_handle());
  boost::system::error_code ignored;
  stream_.close(ignored);
  owner_.ended(error);
}

std::size_t open_stream::queued_bytes() const {
  const std::lock_guard lock(mutex_);
  return queue_.size_bytes();
}

void send_queue::push(std::span<const std::byte> chunk) {
  const auto at = static_cast<std::size_t>(pushed_ % ring_.size());
  const auto until_end = std::min(chunk.size(), ring_.size() - at);
  std::copy_n(chunk.begin(), until_end, ring_.begin() + static_cast<std::ptrdiff_t>(at));
  std::copy(chunk.begin() + static_cast<std::ptrdiff_t>(until_end), chunk.end(), ring_.begin());
  pushed_ += chunk.size();
  ends_.push_back(pushed_);
}

std::span<const std::byte> send_queue::front() const {
  const auto at = static_cast<std::size_t>(popped_ % ring_.size());
  return std::span(ring_).subspan(at, std::min(size_bytes(), ring_.size() - at));
}

std::size_t send_queue::pop(std::size_t bytes) {
  popped_ += bytes;
  std::size_t complete = 0;
  for (; !ends_.empty() && ends_.front() <= popped_; ++complete)
    ends_.pop_front();
  return complete;
}

std::size_t send_queue::clear() {
  const auto chunks = ends_.size();
  ends_.clear();
  popped_ = pushed_;
  return chunks;
}

} // namespace godwit::io::link
