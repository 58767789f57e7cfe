// How long things took, as a histogram of fixed size: 16 steps to each doubling, so that a value is known to 6 %.
//
// Also the waiting time of a message, which the trace has not as such: from the end of the handler that sent it to the
// begin of its own. That is the mailbox, and for what waits for the disk first also that. What an actor sends itself
// (timers) has no waiting time. Units: ns. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/trace/reading/delivery.hpp"

namespace godwit::trace_tool {

class latency_histogram {
public:
  void add(std::int64_t ns);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::int64_t max_ns() const { return max_ns_; }
  [[nodiscard]] std::int64_t total_ns() const { return total_ns_; }
  // At most this long took PART (0 to 1) of them; never more than max_ns().
  [[nodiscard]] std::int64_t quantile_ns(double part) const;
  // How many took at least 2^n and less than 2^(n+1) ns; the last one is not 0.
  [[nodiscard]] std::vector<std::uint64_t> by_doubling() const;

private:
  static constexpr unsigned steps_log2 = 4;
  static constexpr std::uint64_t steps = 1U << steps_log2;

  [[nodiscard]] static std::size_t bucket_of(std::uint64_t ns);
  [[nodiscard]] static std::uint64_t begin_of(std::size_t bucket);

  std::vector<std::uint64_t> buckets_; // as many as are needed
  std::uint64_t count_ = 0;
  std::int64_t max_ns_ = 0;
  std::int64_t total_ns_ = 0;
};

// The ends of the newest handlers, by the id of their message. Memory: fixed; an older one is forgotten for a newer.
class recent_handlers {
public:
  static constexpr std::size_t size = std::size_t{1} << 18U;

  recent_handlers() : slots_(size) {}

  // In the order of time. The waiting time of EACH, if it is known.
  [[nodiscard]] std::optional<std::int64_t> waiting_ns(const runtime::delivery& each);

private:
  struct slot {
    std::uint64_t id = 0;
    std::int64_t ended_ns = 0;
    std::uint32_t actor = 0;
    std::uint32_t run = 0;
  };
  [[nodiscard]] slot& slot_of(std::uint64_t id);

  std::vector<slot> slots_;
};

} // namespace godwit::trace_tool
