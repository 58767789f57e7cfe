// Time that stands still until something happens, and the things that will happen.
#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace godwit::tests {

class virtual_time {
public:
  // START_NS: tests that depend on the phase of somebody's period vary it.
  explicit virtual_time(std::int64_t start_ns) : now_ns_(start_ns) {}

  [[nodiscard]] std::int64_t now_ns() const { return now_ns_; }

  // What is due at the same time happens in the order in which it was put in.
  void at(std::int64_t when_ns, std::function<void()> what) { due_.push({when_ns, order_++, std::move(what)}); }

  // The time of the next; MAX if there is none.
  [[nodiscard]] std::int64_t next_ns() const { return due_.empty() ? INT64_MAX : due_.top().when_ns; }

  void run_next() {
    auto next = due_.top();
    due_.pop();
    advance_to(next.when_ns);
    next.what();
  }

  void advance_to(std::int64_t when_ns) { now_ns_ = std::max(now_ns_, when_ns); }

private:
  struct entry {
    std::int64_t when_ns;
    std::uint64_t order;
    std::function<void()> what;
    bool operator<(const entry& other) const { // the earliest on top
      return std::pair(when_ns, order) > std::pair(other.when_ns, other.order);
    }
  };

  std::int64_t now_ns_;
  std::uint64_t order_ = 0;
  std::priority_queue<entry> due_;
};

} // namespace godwit::tests
