#include "io/sqlite/group_writer.hpp"

#include <algorithm>
#include <utility>

namespace godwit::io::sqlite {

void writer_health::failed(const store_error& why, time_point now) {
  next_try_ = now + delay_;
  delay_ = std::min(delay_ * 2, pace_.last);
  {
    std::lock_guard lock(mutex_);
    ++counts_.retries;
    counts_.last_error = why;
    if (!is_failing_)
      counts_.failing_since = now;
  }
  if (!std::exchange(is_failing_, true) && on_change_)
    on_change_();
}

void writer_health::committed(std::uint64_t items) {
  delay_ = pace_.first;
  {
    std::lock_guard lock(mutex_);
    ++counts_.commits;
    counts_.written += items;
    counts_.failing_since.reset();
    counts_.last_error.reset();
  }
  if (std::exchange(is_failing_, false) && on_change_)
    on_change_();
}

void writer_health::try_at_once(time_point now) {
  next_try_ = now;
  delay_ = pace_.first;
}

writer_counts writer_health::counts() const {
  std::lock_guard lock(mutex_);
  return counts_;
}

} // namespace godwit::io::sqlite
