// One writer of one file: what waits commits as one group, in one transaction with one sync; then everyone is told.
//
//            +-------- nothing waits --------+
//            v                               |
//   [idle] --work--> [group] --committed--> finish each item --> look after the log, or a turn of long work
//                      |  ^
//          disk error  |  | after 10, 20, ... 2000 ms, for ever; at once when closing
//                      v  |
//                    [failing]    nobody hears anything; what comes waits, up to the bound of the queue
//
// An item that can never commit would hold up all the others: the group is tried again without it, and only it is told.
// `run_once` does all of this for one transaction, in the caller's thread; `start` puts a thread around it.
// Thread: push, flush and status from any; close not from the items' own callbacks; run_once only without a thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "io/sqlite/group_target.hpp"
#include "io/sqlite/store_error.hpp"
#include "io/sqlite/work_queue.hpp"

namespace godwit::io::sqlite {

// Whether a disk takes what is written: since when not, why, and when to try again. It is tried for ever, after longer
// and longer waits.
//
//            +--> [working] --failed--> [failing]   failed: the wait doubles, up to the last
//            |                              |
//            +----------- committed --------+
//
// Thread: status from any, the rest the writer's.
struct retry_pace {
  std::chrono::milliseconds first{10};
  std::chrono::milliseconds last{2'000};
};

struct writer_counts {
  using time_point = std::chrono::steady_clock::time_point;

  std::optional<time_point> failing_since; // nothing: the last commit succeeded
  std::optional<store_error> last_error;   // while failing
  std::uint64_t commits = 0;               // transactions that reached the disk
  std::uint64_t written = 0;               // items in them
  std::uint64_t retries = 0;               // transactions tried again after an error
};

class writer_health {
public:
  using time_point = writer_counts::time_point;

  // ON_CHANGE: failing turns on or off.
  writer_health(retry_pace pace, std::function<void()> on_change)
      : pace_(pace), on_change_(std::move(on_change)), delay_(pace.first) {}

  void failed(const store_error& why, time_point now);
  void committed(std::uint64_t items);

  [[nodiscard]] bool is_failing() const { return is_failing_; }
  [[nodiscard]] bool may_try(time_point now) const { return !is_failing_ || now >= next_try_; }
  [[nodiscard]] time_point next_try() const { return next_try_; }
  void try_at_once(time_point now);

  [[nodiscard]] writer_counts counts() const;

private:
  const retry_pace pace_;
  const std::function<void()> on_change_;
  std::chrono::milliseconds delay_;
  time_point next_try_{};
  bool is_failing_ = false; // the writer's own copy, which needs no lock

  mutable std::mutex mutex_;
  writer_counts counts_;
};

struct writer_options {
  queue_limits queue;
  queue_limits group; // of one transaction; at least one item
  retry_pace retry;
  std::chrono::milliseconds close_timeout{5'000}; // of a thread that closes while the disk fails
  std::function<std::chrono::steady_clock::time_point()> clock = &std::chrono::steady_clock::now;
  std::function<void()> on_health_change = {}; // in the writer's thread, when failing turns on or off
};

struct writer_status {
  writer_counts counts;
  queue_load queue;
};

template <class Item>
class group_writer {
public:
  using time_point = std::chrono::steady_clock::time_point;

  // TARGET lives longer.
  group_writer(const writer_options& options, group_target<Item>& target)
      : options_(options), target_(target), queue_(options.queue), health_(options.retry, options.on_health_change) {}
  ~group_writer() { close(); }
  group_writer(const group_writer&) = delete;
  group_writer& operator=(const group_writer&) = delete;

  // Refused: nothing of it will happen, and ITEM is as it was. ADMIT(item) is asked under the queue's lock.
  template <class Admit>
  [[nodiscard]] tl::expected<void, refusal> push(Item&& item, queue_room room, const Admit& admit) {
    return queue_.push(std::move(item), room, admit);
  }
  [[nodiscard]] tl::expected<void, refusal> push(Item&& item, queue_room room = {}) {
    return queue_.push(std::move(item), room, [](const Item&) { return true; });
  }

  // A thread does the work from now on. Before anything else is called.
  void start() {
    has_thread_ = true;
    thread_ = std::thread([this] { run(); });
  }

  // Does what can be done now, at most one transaction.
  void run_once();
  // When run_once has something to do again; nothing: when something is pushed.
  [[nodiscard]] std::optional<time_point> next_run();

  // Until all that was pushed before is finished; false when the time is over, or, without a thread, when the disk
  // fails.
  [[nodiscard]] bool flush(std::chrono::milliseconds timeout) {
    if (has_thread_)
      return queue_.wait_until_finished(timeout);
    while (queue_.load().items > 0) {
      run_once();
      if (health_.is_failing())
        return false;
    }
    return true;
  }

  // Writes what waits: with a thread within the close timeout, without one until the disk fails. Gives up the rest.
  void close();

  [[nodiscard]] writer_status status() const { return {health_.counts(), queue_.load()}; }

private:
  enum class outcome { committed, try_later, one_left_out, all_failed };

  static constexpr std::chrono::seconds look_period{1};
  // Long work gets a turn in this time even while items never cease, so that it ends at all.
  static constexpr std::chrono::milliseconds turn_patience{100};

  void run() {
    while (!has_ended()) {
      queue_.wait(next_run());
      run_once();
    }
    end();
  }
  void collect(time_point now);
  void look_at_file(time_point now) {
    if (now - last_look_ < look_period)
      return;
    last_look_ = now;
    if (const auto seen = target_.look_at_file(); !seen && !health_.is_failing())
      health_.failed(seen.error(), now);
  }
  // Long work can be done again; closing does not wait for it.
  [[nodiscard]] bool has_ended() const {
    return close_deadline_ && (backlog_.empty() || options_.clock() >= *close_deadline_);
  }
  [[nodiscard]] bool is_busy() const { return !backlog_.empty() || queue_.has_arrivals(); }
  void run_barriers() {
    while (!backlog_.empty() && !target_.is_write(backlog_.front().item)) {
      target_.run(backlog_.front().item);
      const auto room = backlog_.front().room;
      backlog_.pop_front();
      queue_.finished(room);
    }
  }
  void run_barriers_early();
  [[nodiscard]] std::size_t group_size() const;
  void commit_group();
  [[nodiscard]] outcome try_group(std::size_t size);
  [[nodiscard]] std::uint64_t written_of(std::size_t group) const;
  void finish_group(std::size_t size);
  void take_turn(time_point now) {
    last_turn_ = now;
    const auto done = target_.take_turn([this] { return queue_.has_arrivals(); });
    if (!done)
      health_.failed(done.error(), options_.clock());
    else if (*done)
      health_.committed(0);
  }
  void end();

  const writer_options options_;
  group_target<Item>& target_;
  work_queue<Item> queue_;
  writer_health health_;

  typename work_queue<Item>::backlog backlog_; // collected, not finished
  std::optional<time_point> close_deadline_;   // set when closing begins
  time_point last_turn_{};
  time_point last_look_{};

  std::mutex close_mutex_;
  bool closed_ = false;
  bool has_thread_ = false;
  std::thread thread_;
};

template <class Item>
void group_writer<Item>::run_once() {
  const auto now = options_.clock();
  collect(now);
  look_at_file(now);
  if (health_.may_try(now)) {
    run_barriers();
    const bool long_work_waits_long = now - last_turn_ > turn_patience;
    if (target_.has_turn() && (!is_busy() || long_work_waits_long))
      take_turn(now);
    else if (!backlog_.empty())
      commit_group();
  }
  if (health_.is_failing())
    run_barriers_early();
  else
    target_.look_after_log(is_busy());
}

template <class Item>
std::optional<typename group_writer<Item>::time_point> group_writer<Item>::next_run() {
  if (backlog_.empty() && !close_deadline_ && !target_.has_turn())
    return has_thread_ ? std::optional(last_look_ + look_period) : std::nullopt;
  if (!health_.is_failing())
    return time_point{};
  return close_deadline_ ? std::min(health_.next_try(), *close_deadline_) : health_.next_try();
}

template <class Item>
void group_writer<Item>::collect(time_point now) {
  const auto known = backlog_.size();
  const bool closing = queue_.collect(backlog_);
  for (auto i = known; i < backlog_.size(); ++i)
    target_.arrived(backlog_[i]);
  if (!closing || close_deadline_)
    return;
  close_deadline_ = now + options_.close_timeout;
  health_.try_at_once(now);
}

template <class Item>
void group_writer<Item>::run_barriers_early() {
  for (std::size_t i = 0; i < backlog_.size();) {
    if (target_.is_write(backlog_[i].item) || !target_.run_early(backlog_, i)) {
      ++i;
      continue;
    }
    const auto room = backlog_[i].room;
    backlog_.erase(backlog_.begin() + static_cast<std::ptrdiff_t>(i));
    queue_.finished(room);
  }
}

// The longest run of writes at the head of the backlog within the bounds of a group; at least one.
template <class Item>
std::size_t group_writer<Item>::group_size() const {
  std::size_t size = 0;
  std::size_t bytes = 0;
  while (size < backlog_.size() && size < options_.group.max_items && target_.is_write(backlog_[size].item)) {
    bytes += backlog_[size].room.bytes;
    if (size > 0 && bytes > options_.group.max_bytes)
      break;
    ++size;
  }
  return size;
}

template <class Item>
void group_writer<Item>::commit_group() {
  const auto size = group_size();
  auto result = outcome::one_left_out;
  while (result == outcome::one_left_out) // at most once for each item of the group
    result = try_group(size);
  if (result == outcome::try_later)
    return;
  if (result == outcome::committed)
    health_.committed(written_of(size));
  finish_group(size);
}

template <class Item>
typename group_writer<Item>::outcome group_writer<Item>::try_group(std::size_t size) {
  auto done = target_.begin();
  for (std::size_t i = 0; done && i < size; ++i) {
    if (backlog_[i].failed)
      continue;
    done = target_.apply(backlog_[i].item);
    if (done || target_.may_pass(done.error()))
      continue;
    target_.roll_back();
    backlog_[i].failed = done.error();
    target_.failed(backlog_, i);
    return outcome::one_left_out;
  }
  if (done)
    done = target_.commit();
  if (done)
    return outcome::committed;
  target_.roll_back();
  health_.failed(done.error(), options_.clock());
  if (target_.may_pass(done.error()))
    return outcome::try_later;
  for (std::size_t i = 0; i < size; ++i) // no later try is better, and all have to hear it
    backlog_[i].failed = done.error();
  return outcome::all_failed;
}

template <class Item>
std::uint64_t group_writer<Item>::written_of(std::size_t group) const {
  const auto end = backlog_.begin() + static_cast<std::ptrdiff_t>(group);
  return static_cast<std::uint64_t>(
      std::count_if(backlog_.begin(), end, [](const auto& each) { return !each.failed; }));
}

template <class Item>
void group_writer<Item>::finish_group(std::size_t size) {
  queue_room room{0, 0};
  for (std::size_t i = 0; i < size; ++i) {
    auto& each = backlog_[i];
    room.items += each.room.items;
    room.bytes += each.room.bytes;
    target_.finish(each.item, each.failed ? store_result<void>(tl::unexpected(*each.failed)) : store_result<void>());
  }
  backlog_.erase(backlog_.begin(), backlog_.begin() + static_cast<std::ptrdiff_t>(size));
  queue_.finished(room);
}

template <class Item>
void group_writer<Item>::close() {
  queue_.close();
  std::lock_guard one_at_a_time(close_mutex_);
  if (std::exchange(closed_, true))
    return;
  if (has_thread_)
    return thread_.join();
  do
    run_once();
  while (!has_ended() && !health_.is_failing());
  end();
}

template <class Item>
void group_writer<Item>::end() {
  const auto why = health_.counts().last_error;
  queue_room room{0, 0};
  for (auto& each : backlog_) {
    target_.give_up(each.item, why);
    room.items += each.room.items;
    room.bytes += each.room.bytes;
  }
  backlog_.clear();
  queue_.finished(room);
  target_.close();
}

} // namespace godwit::io::sqlite
