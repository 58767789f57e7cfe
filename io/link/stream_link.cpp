#include "io/link/stream_link.hpp"

#include <cerrno>

#include <boost/asio/post.hpp>

namespace godwit::io::link {

stream_link::stream_link(const uri& where, link_callbacks callbacks, const link_options& options,
                         std::chrono::milliseconds retry_cap, const make_opener& opener)
    : where_(where), received_(std::move(callbacks.received)), queue_(options.send_queue_bytes),
      opener_(opener(thread_.context())), stream_(thread_.context()),
      life_(thread_.context(), {options.first_retry, retry_cap}, counters_, std::move(callbacks.changed),
            [this] { open(); }) {
  boost::asio::post(thread_.context(), [this] { life_.begin("opening " + where_.text()); });
  thread_.start();
}

stream_link::~stream_link() {
  thread_.stop();
  if (stream_.is_open())
    opener_->discard_output(stream_.native_handle());
}

void stream_link::open() {
  opener_->open([this](stream_opener::result result) {
    if (!result)
      return life_.failed(result.error());
    opened(*std::move(result));
  });
}

void stream_link::opened(descriptor stream) {
  boost::system::error_code error;
  stream_.assign(stream.number(), error);
  if (error)
    return life_.failed(opener_->why_it_ended(error.value()));
  static_cast<void>(stream.release()); // stream_ owns it now
  ++generation_;
  {
    const std::lock_guard lock(mutex_);
    write_descriptor_ = stream_.native_handle();
    write_error_ = 0;
    waits_writable_ = false;
  }
  wait_readable();
  life_.opened("connected to " + opener_->where());
}

void stream_link::wait_readable() {
  stream_.async_wait(boost::asio::posix::stream_descriptor::wait_read,
                     [this, generation = generation_](const boost::system::error_code& cancelled) {
                       if (!cancelled && generation == generation_)
                         read(generation);
                     });
}

void stream_link::read(std::uint64_t generation) {
  for (int n = 0; n < max_reads_a_turn; ++n) {
    const ssize_t size = ::read(stream_.native_handle(), buffer_.data(), buffer_.size());
    if (size < 0 && errno == EINTR)
      continue;
    if (size < 0 && errno == EAGAIN)
      break;
    if (size <= 0)
      return lost(size == 0 ? 0 : errno);
    const auto bytes = std::span(buffer_).first(static_cast<std::size_t>(size));
    counters_.received(bytes.size());
    received_(only_peer, bytes, false);
  }
  if (generation == generation_)
    wait_readable();
}

void stream_link::wait_writable() {
  stream_.async_wait(boost::asio::posix::stream_descriptor::wait_write,
                     [this, generation = generation_](const boost::system::error_code& cancelled) {
                       if (!cancelled && generation == generation_)
                         write_queued(generation);
                     });
}

void stream_link::write_queued(std::uint64_t generation) {
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
stream_link::write_end stream_link::write_queue() {
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
stream_link::write_end stream_link::write_some(std::span<const std::byte> bytes, std::size_t& written) {
  written = 0;
  while (written < bytes.size()) {
    const ssize_t size = opener_->write(write_descriptor_, bytes.subspan(written));
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

bool stream_link::send(std::span<const std::byte> bytes, peer_id to) {
  if (bytes.empty())
    return true;
  if (to > only_peer) {
    counters_.tx_no_peer.add();
    return false;
  }
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
  if (!waits_writable_) {
    waits_writable_ = true;
    boost::asio::post(thread_.context(), [this] {
      if (stream_.is_open())
        wait_writable();
    });
  }
  return true;
}

// Under the lock, by a sender. Closing is for the link's own thread, which may have found out by reading, too.
void stream_link::fail_soon(int error) {
  write_descriptor_ = -1;
  boost::asio::post(thread_.context(), [this, error] {
    if (stream_.is_open())
      lost(error);
  });
}

void stream_link::lost(int error) {
  ++generation_;
  counters_.errors.add(error == 0 ? 0 : 1);
  {
    const std::lock_guard lock(mutex_);
    write_descriptor_ = -1;
    waits_writable_ = false;
    counters_.tx_dropped.add(queue_.clear());
  }
  opener_->discard_output(stream_.native_handle());
  boost::system::error_code ignored;
  stream_.close(ignored);
  life_.failed(opener_->why_it_ended(error));
}

link_counters stream_link::counters() const {
  auto all = counters_.values();
  const std::lock_guard lock(mutex_);
  all.tx_queued_bytes = queue_.size_bytes();
  return all;
}

} // namespace godwit::io::link
