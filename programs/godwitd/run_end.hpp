// Why the run ended, as the first who ended it says. Thread: any.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace godwit::daemon {

class run_end {
public:
  struct outcome {
    bool well = true;
    std::string why; // a sentence for people; empty when all is well
  };

  void set(outcome how) {
    const std::lock_guard guard(mutex_);
    if (!first_)
      first_ = std::move(how);
  }
  // Nothing: it was ended from outside.
  [[nodiscard]] std::optional<outcome> get() const {
    const std::lock_guard guard(mutex_);
    return first_;
  }

private:
  mutable std::mutex mutex_;
  std::optional<outcome> first_;
};

} // namespace godwit::daemon
