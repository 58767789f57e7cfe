// The drill's own book, outside the actors, where no crash reaches it: how often each message came to its end.
// Messages are numbered from 1. Thread: mark() by one thread at a time; done() by any; the rest when all is over.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace godwit::drill {

class audit {
public:
  explicit audit(std::uint64_t messages) : times_(messages + 1) {}

  void mark(std::uint64_t seq) {
    auto& times = times_.at(seq);
    if (times == 0)
      done_.store(done_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    if (times < UINT8_MAX)
      ++times;
  }

  [[nodiscard]] std::uint64_t done() const { return done_.load(std::memory_order_acquire); }
  [[nodiscard]] bool is_done(std::uint64_t seq) const { return times_.at(seq) > 0; }

  // Marks beyond the first of each message.
  [[nodiscard]] std::uint64_t repeated() const {
    std::uint64_t result = 0;
    for (const auto times : times_)
      result += times > 1 ? times - 1U : 0U;
    return result;
  }

private:
  std::vector<std::uint8_t> times_;
  std::atomic<std::uint64_t> done_{0};
};

} // namespace godwit::drill
