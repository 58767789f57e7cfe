#include "actors/vehicle_link/transfer/round_trip.hpp"

#include <algorithm>
#include <cstdlib>

namespace godwit::vehicle_link::transfer {

void round_trip::sample(std::int64_t round_trip_ns) {
  round_trip_ns = std::clamp<std::int64_t>(round_trip_ns, 1, max_timeout_ns);
  const auto usual_ns = is_certain() ? 2 * smoothed_ns_ + min_margin_ns : first_timeout_ns;
  outliers_ = round_trip_ns > usual_ns ? outliers_ + 1 : 0;
  const bool is_believed = outliers_ == 0 || outliers_ >= outliers_believed;
  if (!is_certain()) {
    // The next one shall come before the time-out.
    guess_ns_ = std::clamp(round_trip_ns + round_trip_ns / 2, guess_ns_, max_guess_ns);
    if (is_believed)
      on_first_sample(round_trip_ns);
    return;
  }
  if (!is_believed)
    return;
  shortest_ns_ = std::min(shortest_ns_, round_trip_ns);
  const auto error = round_trip_ns - smoothed_ns_;
  deviation_ns_ += (std::abs(error) - deviation_ns_) / 4;
  smoothed_ns_ = std::max<std::int64_t>(smoothed_ns_ + error / 8, 1);
}

void round_trip::on_first_sample(std::int64_t round_trip_ns) {
  smoothed_ns_ = shortest_ns_ = round_trip_ns;
  deviation_ns_ = round_trip_ns / 2;
  ambiguous_.reset();
}

void round_trip::ambiguous_sample(const ambiguous& answer) {
  if (is_certain()) {
    if (answer.since_first_ns && is_too_soon(answer.since_last_ns))
      sample(*answer.since_first_ns);
    return;
  }
  if (confirms(answer)) {
    on_first_sample(std::max<std::int64_t>(answer.since_last_ns, 1));
    return;
  }
  ambiguous_ = answer;
  // As for a first sample: the deviation is taken for a half of it.
  const auto guess_ns = std::max(3 * answer.since_last_ns, min_guess_ns);
  if (lower_guesses_left_ == 0 || guess_ns >= guess_ns_)
    return;
  --lower_guesses_left_;
  guess_ns_ = guess_ns;
}

bool round_trip::confirms(const ambiguous& answer) const {
  if (!ambiguous_)
    return false;
  const auto differ_ns = [](std::int64_t a, std::int64_t b) { return std::abs(a - b); };
  return differ_ns(answer.since_last_ns, ambiguous_->since_last_ns) <= min_margin_ns &&
         differ_ns(answer.between_copies_ns, ambiguous_->between_copies_ns) > 2 * min_margin_ns;
}

void round_trip::on_silence() { guess_ns_ = std::min(guess_ns_ + guess_ns_ / 2, max_guess_ns); }

std::int64_t round_trip::timeout_ns() const {
  if (!is_certain())
    return guess_ns_;
  return std::min(smoothed_ns_ + std::max(4 * deviation_ns_, min_margin_ns), max_timeout_ns);
}

} // namespace godwit::vehicle_link::transfer
