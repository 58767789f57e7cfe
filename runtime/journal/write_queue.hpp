// What waits for the journal's writer: writes and recoveries in the order of their arrival, and large loads beside
// them.
//
// Bounded in number and in bytes, from submission until `finished`. Refuses writes of an incarnation whose successor
// has asked for recovery: both take the same lock, so the order of the two calls decides. Thread: any; take and
// finished are the writer's.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "runtime/journal/journal.hpp"

namespace godwit::runtime {

struct queued_write {
  journal_write write;
  std::size_t bytes = 0;
  std::optional<journal_error> failed; // it can never commit; its turn only tells it so
};

struct queued_recovery {
  std::string actor;
  journal::recovered_callback callback;
};

using queue_item = std::variant<queued_write, queued_recovery>;

struct queue_limits {
  std::size_t max_writes = 0;
  std::size_t max_bytes = 0;
  std::size_t max_loads = 0;
};

class write_queue {
public:
  using time_point = std::chrono::steady_clock::time_point;

  explicit write_queue(queue_limits limits) : limits_(limits) {}

  // The code says why not: queue_full, stale_incarnation or closed.
  [[nodiscard]] tl::expected<void, journal_errc> push(journal_write&& write);
  // False when closed; then the argument is untouched.
  [[nodiscard]] bool push(queued_recovery&& recovery, std::uint64_t incarnation);
  [[nodiscard]] tl::expected<void, journal_errc> push(bulk_load&& load);

  // Nothing is taken from now on; the writer wakes.
  void close();

  // Appends what has arrived; waits for it until UNTIL (nothing = for ever). Returns true when the queue is closed.
  bool take(std::deque<queue_item>& items, std::deque<bulk_load>& loads, std::optional<time_point> until);

  void finished(std::size_t writes, std::size_t bytes);
  void load_finished();

  // True once all that was pushed before the call is finished.
  [[nodiscard]] bool wait_until_finished(std::chrono::milliseconds timeout);

  // Writes that arrived since the last take: a load cuts its chunk short for them.
  [[nodiscard]] bool has_arrivals() const { return arrived_.load(std::memory_order_relaxed); }

  [[nodiscard]] std::uint64_t refused() const;
  [[nodiscard]] std::uint64_t queued() const;

private:
  void wake(std::unique_lock<std::mutex> lock);

  const queue_limits limits_;
  mutable std::mutex mutex_;
  std::condition_variable wake_writer_;
  std::condition_variable progress_;
  std::vector<queue_item> arrivals_;
  std::vector<bulk_load> load_arrivals_;
  std::unordered_map<std::string, std::uint64_t> first_valid_incarnation_; // one entry for each actor that recovered
  std::size_t writes_ = 0;                                                 // submitted and not finished
  std::size_t bytes_ = 0;
  std::size_t loads_ = 0;
  std::uint64_t pushed_ = 0;   // in total
  std::uint64_t finished_ = 0; // in total; writes finish in order
  std::uint64_t refused_ = 0;
  bool closed_ = false;
  bool writer_sleeps_ = false;
  std::atomic<bool> arrived_{false};
};

} // namespace godwit::runtime
