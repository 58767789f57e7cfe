#include "actors/mapobjects_store/work_queue.hpp"

#include <iterator>

namespace godwit::mapobjects_store {

map_result<void> work_queue::push(queued_work item) {
  {
    std::lock_guard lock(mutex_);
    if (closed_)
      return tl::unexpected(map_error{map_errc::closed, "the map is closed", {}});
    if (items_ >= max_items_)
      return tl::unexpected(map_error{map_errc::full, "the writer of the map is behind by its bound",
                                      "Look at its health: the disk is failing or too slow"});
    ++items_;
    arrivals_.push_back(std::move(item));
    arrived_.store(true, std::memory_order_relaxed);
  }
  wake_.notify_one();
  return {};
}

void work_queue::close() {
  {
    std::lock_guard lock(mutex_);
    closed_ = true;
    arrived_.store(true, std::memory_order_relaxed);
  }
  wake_.notify_one();
}

bool work_queue::take(std::deque<queued_work>& items, std::optional<time_point> until) {
  std::unique_lock lock(mutex_);
  const auto something = [&] { return arrived_.load(std::memory_order_relaxed); };
  if (until)
    wake_.wait_until(lock, *until, something);
  else
    wake_.wait(lock, something);
  arrived_.store(false, std::memory_order_relaxed);
  std::move(arrivals_.begin(), arrivals_.end(), std::back_inserter(items));
  arrivals_.clear();
  return closed_;
}

void work_queue::finished(std::size_t count) {
  std::lock_guard lock(mutex_);
  items_ -= count;
}

std::size_t work_queue::size() const {
  std::lock_guard lock(mutex_);
  return items_;
}

} // namespace godwit::mapobjects_store
