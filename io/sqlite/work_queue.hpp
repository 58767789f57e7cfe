// What waits for a group_writer, in the order of its arrival. Bounded in number and in bytes from `push` until
// `finished`.
//
// Thread: any; wait, collect and finished are the writer's.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

#include "io/sqlite/store_error.hpp"

namespace godwit::io::sqlite {

// What an item takes of the bounds. An item that takes none is never refused for want of room.
struct queue_room {
  std::size_t items = 1;
  std::size_t bytes = 0;
};

template <class Item>
struct queued {
  Item item;
  queue_room room;
  std::optional<store_error> failed = {}; // it can never commit; its turn only tells it so
};

enum class refusal { full, closed, not_admitted };

struct queue_limits {
  std::size_t max_items = std::numeric_limits<std::size_t>::max();
  std::size_t max_bytes = std::numeric_limits<std::size_t>::max();
};

struct queue_load {
  std::uint64_t items = 0;
  std::uint64_t bytes = 0;
  std::uint64_t refused = 0; // in total
  double fill = 0;           // of the bound that is nearer: 0 = empty, 1 = full
};

// From this fill on, whoever can do without further writes should.
inline constexpr double nearly_full = 0.8;

template <class Item>
class work_queue {
public:
  using time_point = std::chrono::steady_clock::time_point;
  using backlog = std::deque<queued<Item>>;

  explicit work_queue(queue_limits limits) : limits_(limits) {}

  // Refused: nothing of it will happen, and ITEM is as it was. ADMIT is asked under the queue's lock, so that two calls
  // agree on their order.
  template <class Admit>
  [[nodiscard]] tl::expected<void, refusal> push(Item&& item, queue_room room, const Admit& admit);

  // Nothing is taken from now on; the writer wakes.
  void close() {
    std::unique_lock lock(mutex_);
    closed_ = true;
    wake(std::move(lock));
  }

  // Until something has arrived, the queue is closed, or UNTIL (nothing = for ever).
  void wait(std::optional<time_point> until) {
    const auto spin_end = std::chrono::steady_clock::now() + spin_before_sleep;
    while (!has_arrivals()) {
      const auto now = std::chrono::steady_clock::now();
      if (now >= spin_end || (until && now >= *until))
        break;
      std::this_thread::yield();
    }
    std::unique_lock lock(mutex_);
    const auto something = [this] { return has_arrivals(); };
    writer_sleeps_ = true;
    if (until)
      wake_writer_.wait_until(lock, *until, something);
    else
      wake_writer_.wait(lock, something);
    writer_sleeps_ = false;
  }

  // Appends what has arrived. True when the queue is closed.
  bool collect(backlog& to) {
    std::lock_guard lock(mutex_);
    arrived_.store(false, std::memory_order_relaxed);
    std::move(arrivals_.begin(), arrivals_.end(), std::back_inserter(to));
    arrivals_.clear();
    return closed_;
  }

  void finished(queue_room room) {
    {
      std::lock_guard lock(mutex_);
      taken_.items -= room.items;
      taken_.bytes -= room.bytes;
      finished_ += room.items;
    }
    progress_.notify_all();
  }

  // True once all that was pushed before the call is finished.
  [[nodiscard]] bool wait_until_finished(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    const auto target = pushed_;
    return progress_.wait_for(lock, timeout, [&] { return finished_ >= target; });
  }

  // Something came since it was collected last.
  [[nodiscard]] bool has_arrivals() const { return arrived_.load(std::memory_order_relaxed); }
  [[nodiscard]] queue_load load() const {
    std::lock_guard lock(mutex_);
    const auto part = [](std::size_t taken, std::size_t bound) {
      return static_cast<double>(taken) / static_cast<double>(std::max<std::size_t>(bound, 1));
    };
    return {.items = taken_.items,
            .bytes = taken_.bytes,
            .refused = refused_,
            .fill = std::max(part(taken_.items, limits_.max_items), part(taken_.bytes, limits_.max_bytes))};
  }

private:
  // How long the idle writer looks for work before it sleeps. Waking a sleeping thread costs about 50 us, a third of a
  // commit; under load the next item comes within this time, and an idle system sleeps.
  static constexpr std::chrono::microseconds spin_before_sleep{30};

  void wake(std::unique_lock<std::mutex> lock) {
    arrived_.store(true, std::memory_order_release);
    const bool sleeps = writer_sleeps_;
    lock.unlock();
    if (sleeps)
      wake_writer_.notify_one();
  }

  const queue_limits limits_;
  mutable std::mutex mutex_;
  std::condition_variable wake_writer_;
  std::condition_variable progress_;
  std::vector<queued<Item>> arrivals_;
  queue_room taken_{0, 0};     // pushed and not finished
  std::uint64_t pushed_ = 0;   // in total
  std::uint64_t finished_ = 0; // in total; items finish in order
  std::uint64_t refused_ = 0;
  bool closed_ = false;
  bool writer_sleeps_ = false;
  std::atomic<bool> arrived_{false};
};

template <class Item>
template <class Admit>
tl::expected<void, refusal> work_queue<Item>::push(Item&& item, queue_room room, const Admit& admit) {
  std::unique_lock lock(mutex_);
  if (closed_)
    return tl::unexpected(refusal::closed);
  const bool admitted = admit(item);
  const bool fits = taken_.items + room.items <= limits_.max_items && room.bytes <= limits_.max_bytes - taken_.bytes;
  if (!admitted || (!fits && room.items > 0)) {
    ++refused_;
    return tl::unexpected(admitted ? refusal::full : refusal::not_admitted);
  }
  taken_.items += room.items;
  taken_.bytes += room.bytes;
  pushed_ += room.items;
  arrivals_.push_back({std::move(item), room});
  wake(std::move(lock));
  return {};
}

} // namespace godwit::io::sqlite
