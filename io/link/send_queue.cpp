#include "io/link/send_queue.hpp"

#include <algorithm>

namespace godwit::io::link {

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
