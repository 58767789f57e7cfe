// A long job on the map, done in turns between the changes of others.
//
// Each call of `stage` runs inside a transaction of the caller's. `committed` moves on; without it the same rows come
// again, so that a disk error costs nothing but time. Thread: the writer's.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

#include "actors/mapobjects_store/map_tables.hpp"

namespace godwit::mapobjects_store {

// How much of a long job is done before others get their turn: a chunk of rows or of time, or until something urgent
// waits.
//
// Thread: the one of the job.

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

class staged_work {
public:
  staged_work() = default;
  staged_work(const staged_work&) = delete;
  staged_work& operator=(const staged_work&) = delete;
  virtual ~staged_work() = default;

  // True when nothing is left to be done after this one.
  [[nodiscard]] virtual map_result<bool> stage(map_tables& t, decision_context& now) = 0;
  virtual void committed() = 0;

  // Whether the next turn has to be on the disk when it is committed. Otherwise that waits for the next one that has
  // to: a turn that a loss of power can take back without harm should not wait for the disk.
  [[nodiscard]] virtual bool must_be_synced() const = 0;

  // Once, after the last commit, or with the error that ended it.
  virtual void finish(const map_result<void>& result) = 0;
};

} // namespace godwit::mapobjects_store
