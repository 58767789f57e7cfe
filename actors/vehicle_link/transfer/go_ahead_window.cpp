#include "actors/vehicle_link/transfer/go_ahead_window.hpp"

#include <algorithm>

namespace godwit::vehicle_link::transfer {

// The loss of the first items says little yet: as if so many had come before.
constexpr int items_before = 8;
// What is measured fades: a line changes.
constexpr int items_remembered = 256;
// A burst of so many times the items between two losses takes the least time at a loss of 5 to 20 % (measured).
constexpr double bursts_between_losses = 1.8;

int go_ahead_window::largest() const {
  if (lost_ == 0)
    return max_;
  const auto between_losses = (taken_in_all_ + items_before) / lost_;
  return std::clamp(static_cast<int>(bursts_between_losses * between_losses), std::min(min_after_loss, max_), max_);
}

void go_ahead_window::on_progress(int items, std::int64_t round_trip_ns, bool is_certain) {
  taken_in_all_ += items;
  if (taken_in_all_ > items_remembered) {
    taken_in_all_ /= 2;
    lost_ /= 2;
  }
  if (is_certain)
    shortest_ns_ = shortest_ns_ == 0 ? round_trip_ns : std::min(shortest_ns_, round_trip_ns);
  const auto in_queue = waiting(round_trip_ns);
  is_fillable_ = is_fillable_ || in_queue >= enough_waiting;
  const bool is_plausible = shortest_ns_ != 0 && round_trip_ns >= shortest_ns_;
  if (is_plausible && !is_fillable_) {
    size_ = std::min(size_ + items, std::max(largest(), size_));
    return;
  }
  taken_ += items;
  if (taken_ < size_)
    return;
  taken_ = 0;
  if (in_queue < enough_waiting)
    size_ = std::min(size_ + 1, std::max(largest(), size_));
  else if (in_queue > too_many_waiting)
    size_ = std::max(size_ - 1, 1);
}

void go_ahead_window::on_loss() {
  ++lost_;
  const auto half = std::max(size_ / 2, std::min(min_after_loss, max_));
  size_ = std::min(is_fillable_ ? half : size_, largest());
  taken_ = 0;
}

double go_ahead_window::waiting(std::int64_t round_trip_ns) const {
  if (shortest_ns_ == 0 || round_trip_ns <= shortest_ns_)
    return 0;
  return size_ * (1.0 - static_cast<double>(shortest_ns_) / static_cast<double>(round_trip_ns));
}

} // namespace godwit::vehicle_link::transfer
