#include "programs/godwit-trace/chunk_queue.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <sys/eventfd.h>
#include <unistd.h>

namespace godwit::trace_tool {

chunk_queue::chunk_queue() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (descriptor_ < 0)
    throw std::system_error(errno, std::generic_category(), "eventfd");
}

chunk_queue::~chunk_queue() { ::close(descriptor_); }

void chunk_queue::push(heard_chunk chunk) {
  {
    const std::lock_guard guard(mutex_);
    // A change of the status is always told: there are few, and each says what the next bytes mean.
    const bool has_room =
        waiting_bytes_ + chunk.bytes.size() <= max_waiting_bytes && waiting_.size() < max_waiting_chunks;
    if (!has_room && !chunk.status) {
      dropped_bytes_ += chunk.bytes.size();
      return;
    }
    waiting_bytes_ += chunk.bytes.size();
    waiting_.push_back(std::move(chunk));
  }
  const std::uint64_t one = 1;
  static_cast<void>(!::write(descriptor_, &one, sizeof one)); // fails only when the descriptor is readable already
}

std::vector<heard_chunk> chunk_queue::take() {
  std::uint64_t ignored = 0;
  static_cast<void>(!::read(descriptor_, &ignored, sizeof ignored)); // fails only when nothing was pushed
  const std::lock_guard guard(mutex_);
  waiting_bytes_ = 0;
  return std::exchange(waiting_, {});
}

std::uint64_t chunk_queue::dropped_bytes() const {
  const std::lock_guard guard(mutex_);
  return dropped_bytes_;
}

} // namespace godwit::trace_tool
