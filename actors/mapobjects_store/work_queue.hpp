// What waits for the writer of the map, in the order of its arrival. Bounded in number from `push` until `finished`.
//
// Thread: any; take and finished are the writer's.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>

#include "actors/mapobjects_store/map_store.hpp"

namespace godwit::mapobjects_store {

// A change of the map, tried again from its beginning when the disk refuses it.
struct queued_change {
  map_store::change work;
  std::function<void(const map_result<void>&)> done;
};

// Makes a long job when all that came before it is durable; tells its asker itself when that fails.
struct queued_job {
  std::function<std::unique_ptr<staged_work>(map_store&)> start;
  std::function<void(const map_error&)> dropped; // instead of being started
};

using queued_work = std::variant<queued_change, queued_job>;

class work_queue {
public:
  using time_point = std::chrono::steady_clock::time_point;

  explicit work_queue(std::size_t max_items) : max_items_(max_items) {}

  // Refused (full, closed): nothing of it will happen.
  [[nodiscard]] map_result<void> push(queued_work item);

  // Nothing is taken from now on; the writer wakes.
  void close();

  // Appends what has arrived; waits for it until UNTIL (nothing = for ever). True when the queue is closed.
  bool take(std::deque<queued_work>& items, std::optional<time_point> until);

  void finished(std::size_t count);

  // Something came since the last take: a long job ends its turn.
  [[nodiscard]] bool has_arrivals() const { return arrived_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::size_t size() const;

private:
  const std::size_t max_items_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<queued_work> arrivals_;
  std::size_t items_ = 0; // pushed and not finished
  bool closed_ = false;
  std::atomic<bool> arrived_{false};
};

} // namespace godwit::mapobjects_store
