// Whether a disk takes what is written: since when not, why, and when to try again. It is tried for ever, after longer
// and longer waits.
//
//            +--> [working] --failed--> [failing]   failed: the wait doubles, up to the last
//            |                              |
//            +----------- committed --------+
//
// Thread: status from any, the rest the writer's.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "io/sqlite/store_error.hpp"

namespace godwit::io::sqlite {

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

} // namespace godwit::io::sqlite
