#include "io/http/kept_wires.hpp"

namespace godwit::io::http {

std::unique_ptr<wire> kept_wires::take(std::chrono::steady_clock::time_point now) {
  std::unique_ptr<wire> found;
  while (!wires_.empty() && !found) {
    auto newest = std::move(wires_.back());
    wires_.pop_back();
    if (now - newest->idle_since < keep_for_ && newest->is_quiet())
      found = std::move(newest);
  }
  gauge_ = wires_.size();
  return found;
}

void kept_wires::put(std::unique_ptr<wire> unused, std::chrono::steady_clock::time_point now) {
  unused->idle_since = now;
  wires_.push_back(std::move(unused));
  while (wires_.size() > max_kept_)
    wires_.pop_front();
  gauge_ = wires_.size();
}

} // namespace godwit::io::http
