#include "programs/godwitd/watchdog_notifier.hpp"

#include <algorithm>
#include <utility>

namespace godwit::daemon {

watchdog_notifier::watchdog_notifier(const service_manager& manager, pulse_view view, std::string about)
    : manager_(manager), view_(std::move(view)), about_(std::move(about)) {}

void watchdog_notifier::end() {
  {
    const std::lock_guard guard(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable())
    thread_.join();
}

void watchdog_notifier::start() {
  thread_ = std::thread([this] { run(); });
}

std::chrono::microseconds watchdog_notifier::period() const {
  const std::chrono::microseconds longest = max_period;
  return manager_.watchdog() ? std::min(longest, *manager_.watchdog() / 2) : longest;
}

void watchdog_notifier::run() {
  std::unique_lock guard(mutex_);
  while (!is_over_) {
    guard.unlock();
    beat();
    guard.lock();
    changed_.wait_for(guard, is_ready_ ? period() : std::min<std::chrono::microseconds>(period(), until_ready),
                      [this] { return is_over_; });
  }
}

void watchdog_notifier::beat() {
  const std::lock_guard guard(mutex_);
  if (!is_ready_ && view_.has_begun()) {
    is_ready_ = true;
    manager_.tell_ready();
  }
  tell_health();
  if (view_.is_responsive())
    manager_.tell_alive();
}

void watchdog_notifier::tell_health() {
  auto now = view_.health();
  for (const auto& each : health_changes(last_, now))
    view_.tell(each);
  auto status = about_ + health_in_a_line(now);
  if (is_ready_ && status != last_status_) {
    manager_.tell_status(status);
    last_status_ = std::move(status);
  }
  last_ = std::move(now);
}

void watchdog_notifier::around_reload(const std::function<void()>& reload) {
  const std::lock_guard guard(mutex_);
  const bool is_told = is_ready_ && !is_over_;
  if (is_told)
    manager_.tell_reloading();
  reload();
  if (is_told)
    manager_.tell_ready();
}

} // namespace godwit::daemon
