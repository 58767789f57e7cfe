#include "io/http/connection_pool.hpp"

namespace godwit::io::http {

std::unique_ptr<connection> connection_pool::take(std::chrono::steady_clock::time_point now) {
  std::unique_ptr<connection> found;
  while (!idle_.empty() && !found) {
    auto newest = std::move(idle_.back());
    idle_.pop_back();
    if (now - newest->idle_since < keep_for_ && newest->is_quiet())
      found = std::move(newest);
  }
  gauge_ = idle_.size();
  return found;
}

void connection_pool::put(std::unique_ptr<connection> unused, std::chrono::steady_clock::time_point now) {
  unused->idle_since = now;
  idle_.push_back(std::move(unused));
  while (idle_.size() > max_kept_)
    idle_.pop_front();
  gauge_ = idle_.size();
}

} // namespace godwit::io::http
