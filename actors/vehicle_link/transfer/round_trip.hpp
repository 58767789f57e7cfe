// How long an answer takes on this line: smoothed round trip and its deviation, as TCP keeps them.
//
// The answer to what was sent once is a sample. When it was sent several times it is not known which of the copies was
// answered (Karn's problem), and on a line that loses a fifth nearly everything is. So of an ambiguous answer this much
// is believed:
//   nothing certain is known yet                       it answers the last copy, and the first guess was too high; a
//                                                      few times, for the guess grows again when nothing comes
//   nothing certain is known yet, and the one before   it answers the last copy, for certain: had they answered the
//   came as long after its last copy, though its       copies before, the two would differ as the waits between the
//   copies lay otherwise apart                         copies do
//   it came after the last copy in less than 3/4 of    it answers the copy before (Eifel's rule): the line has become
//   the shortest time ever, and there were two copies  slower, and the resend was in vain
// A sample of more than twice the usual time, or of more than the first time-out where nothing is known yet, is left
// out, unless it is the third in a row: the vehicle asks again by itself, and where its first request was lost the
// second looks like a late answer. A line that is slow, or has become slower, shows in every answer. One object serves
// all transfers over a line, so that the second transfer knows what the first one learned. Source: Jacobson,
// "Congestion avoidance and control", 1988; RFC 6298; RFC 3522. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>

namespace godwit::vehicle_link::transfer {

class round_trip {
public:
  // Before anything is known of the line. A telemetry radio answers within 150 ms, and PX4 asks again after 260 ms by
  // itself, which must not be taken for an answer.
  static constexpr std::int64_t first_timeout_ns = 200'000'000;
  // What is added to the round trip at least: a scheduler's and a main loop's delay.
  static constexpr std::int64_t min_margin_ns = 4'000'000;
  static constexpr std::int64_t max_timeout_ns = 1'500'000'000;
  static constexpr int outliers_believed = 3; // in a row

  // The answer to what was sent once.
  void sample(std::int64_t round_trip_ns);

  // Nothing came in time.
  void on_silence();

  // An answer that may not be one to the last copy.
  struct ambiguous {
    std::int64_t since_last_ns = 0;
    std::int64_t between_copies_ns = 0;         // the last two; 0: there was one, and it may be no answer at all
    std::optional<std::int64_t> since_first_ns; // if there were just two copies
  };
  void ambiguous_sample(const ambiguous& answer);

  // There has been a sample.
  [[nodiscard]] bool is_certain() const { return smoothed_ns_ != 0; }

  // An answer can not have come so soon: it is one to something else.
  [[nodiscard]] bool is_too_soon(std::int64_t since_ns) const { return since_ns < shortest_ns_ * 3 / 4; }

  // If so much time has passed, and the vehicle says that something has not come, then it is lost.
  [[nodiscard]] bool is_enough(std::int64_t since_ns) const { return since_ns > shortest_ns_ * 5 / 4 + min_margin_ns; }

  // The usual time; 0 when nothing is known.
  [[nodiscard]] std::int64_t smoothed_ns() const { return smoothed_ns_; }

  // After so long an answer is overdue.
  [[nodiscard]] std::int64_t timeout_ns() const;

private:
  void on_first_sample(std::int64_t round_trip_ns);
  [[nodiscard]] bool confirms(const ambiguous& answer) const;

  static constexpr std::int64_t min_guess_ns = 100'000'000;
  static constexpr std::int64_t max_guess_ns = 1'000'000'000;
  static constexpr int max_lower_guesses = 3;

  std::int64_t smoothed_ns_ = 0;
  std::int64_t deviation_ns_ = 0;
  std::int64_t shortest_ns_ = 0;
  int outliers_ = 0;
  std::optional<ambiguous> ambiguous_;       // the last one, while nothing is certain
  std::int64_t guess_ns_ = first_timeout_ns; // of the time-out, until there is a sample
  int lower_guesses_left_ = max_lower_guesses;
};

} // namespace godwit::vehicle_link::transfer
