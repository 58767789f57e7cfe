#include "actors/vehicle_link/transfer/round_trip.hpp"

#include <algorithm>
#include <cstdlib>

namespace godwit::vehicle_link::transfer {

void round_trip::sample(std::int64_t round_trip_ns) {
  round_trip_ns = std::clamp<std::int64_t>(round_trip_ns, 1, max_timeout_ns);
  if (!is_certain()) {
    smoothed_ns_ = shortest_ns_ = round_trip_ns;
    deviation_ns_ = round_trip_ns / 2;
    return;
  }
  outliers_ = round_trip_ns > 2 * smoothed_ns_ + min_margin_ns ? outliers_ + 1 : 0;
  if (outliers_ != 0 && outliers_ < outliers_believed)
    return;
  shortest_ns_ = std::min(shortest_ns_, round_trip_ns);
  const auto error = round_trip_ns - smoothed_ns_;
  deviation_ns_ += (std::abs(error) - deviation_ns_) / 4;
  smoothed_ns_ = std::max<std::int64_t>(smoothed_ns_ + error / 8, 1);
}

void round_trip::ambiguous_sample(std::int64_t since_last_ns, std::optional<std::int64_t> since_first_ns) {
  if (is_certain()) {
    if (since_first_ns && is_too_soon(since_last_ns))
      sample(*since_first_ns);
    return;
  }
  // As for a first sample: the deviation is taken for a half of it.
  const auto guess_ns = std::max(3 * since_last_ns, min_guess_ns);
  if (lower_guesses_left_ == 0 || guess_ns >= guess_ns_)
    return;
  --lower_guesses_left_;
  guess_ns_ = guess_ns;
}

void round_trip::on_silence() { guess_ns_ = std::min(guess_ns_ + guess_ns_ / 2, max_guess_ns); }

std::int64_t round_trip::timeout_ns() const {
  if (!is_certain())
    return guess_ns_;
  return std::min(smoothed_ns_ + std::max(4 * deviation_ns_, min_margin_ns), max_timeout_ns);
}

} // namespace godwit::vehicle_link::transfer
