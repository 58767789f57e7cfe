#include "actors/vehicle_link/transfer/go_ahead_window.hpp"

#include <algorithm>

namespace godwit::vehicle_link::transfer {

void go_ahead_window::on_progress(int items, std::int64_t round_trip_ns, bool is_certain) {
  if (is_certain)
    shortest_ns_ = shortest_ns_ == 0 ? round_trip_ns : std::min(shortest_ns_, round_trip_ns);
  const auto in_queue = waiting(round_trip_ns);
  is_fillable_ = is_fillable_ || in_queue >= enough_waiting;
  const bool is_plausible = shortest_ns_ != 0 && round_trip_ns >= shortest_ns_;
  if (is_plausible && !is_fillable_) {
    size_ = std::min(size_ + items, max_);
    return;
  }
  taken_ += items;
  if (taken_ < size_)
    return;
  taken_ = 0;
  if (in_queue < enough_waiting)
    size_ = std::min(size_ + 1, max_);
  else if (in_queue > too_many_waiting)
    size_ = std::max(size_ - 1, 1);
}

void go_ahead_window::on_loss() {
  size_ = std::clamp(size_ / 2, std::min(min_after_loss, max_), max_);
  taken_ = 0;
}

double go_ahead_window::waiting(std::int64_t round_trip_ns) const {
  if (shortest_ns_ == 0 || round_trip_ns <= shortest_ns_)
    return 0;
  return size_ * (1.0 - static_cast<double>(shortest_ns_) / static_cast<double>(round_trip_ns));
}

} // namespace godwit::vehicle_link::transfer
