// How much of a long job is done before others get their turn: a chunk of rows or of time, or until something urgent
// waits.
//
// Thread: the one of the job.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

namespace godwit::mapobjects_store {

// One transaction of a long job: bounds what has to be written at its end. A sighting that comes in the middle ends the
// turn long before.
inline constexpr std::size_t max_chunk_rows = 2000;
inline constexpr std::chrono::milliseconds max_chunk_time{50};

class decision_context {
public:
  using time_point = std::chrono::steady_clock::time_point;

  // URGENT is asked now and then; true ends the turn early. CLOCK lives longer.
  decision_context(const std::function<bool()>& urgent, const std::function<time_point()>& clock)
      : urgent_(&urgent), clock_(&clock), end_(clock() + max_chunk_time) {}

  // A turn without end but that of the rows, for whoever has nobody waiting.
  decision_context() = default;

  // After each row: whether the turn is over.
  [[nodiscard]] bool over_after_row() {
    ++rows_;
    if (rows_ >= max_chunk_rows)
      return true;
    if (rows_ % rows_between_looks != 0)
      return false;
    return urgent_ != nullptr && ((*urgent_)() || (*clock_)() >= end_);
  }

private:
  // A row takes some 3 to 50 us.
  static constexpr std::size_t rows_between_looks = 16;

  const std::function<bool()>* urgent_ = nullptr;
  const std::function<time_point()>* clock_ = nullptr;
  time_point end_;
  std::size_t rows_ = 0;
};

} // namespace godwit::mapobjects_store
