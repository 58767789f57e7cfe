#include "runtime/journal/load_stage.hpp"

#include "runtime/assert.hpp"

namespace godwit::runtime {

namespace {

// Looking at the clock and the queue for every row would cost as much as the row; 64 rows take about 0.2 ms.
constexpr std::size_t rows_between_looks = 64;

} // namespace

void load_stage::fetch() {
  chunk_.clear();
  next_row_ = 0;
  last_chunk_ = !load_.next(chunk_, limits_.max_rows);
  GODWIT_ASSERT(chunk_.size() <= limits_.max_rows,
                "journal: load " + load_.name + " gave more rows than it was asked for");
}

io::sqlite::result<void> load_stage::stage(record_store& store, const std::function<bool()>& urgent) {
  if (next_row_ == chunk_.size() && !last_chunk_)
    fetch();
  flipping_ = next_row_ == chunk_.size() && last_chunk_;
  if (flipping_) {
    for (const auto& change : load_.flip)
      if (auto done = store.apply(change); !done)
        return done;
    return {};
  }
  const auto end = std::chrono::steady_clock::now() + limits_.max_time;
  for (staged_row_ = next_row_; staged_row_ < chunk_.size();) {
    if (auto done = store.apply(chunk_[staged_row_]); !done)
      return done;
    ++staged_row_;
    const bool look = (staged_row_ - next_row_) % rows_between_looks == 0;
    if (look && (urgent() || std::chrono::steady_clock::now() >= end))
      break;
  }
  return {};
}

void load_stage::committed() {
  if (flipping_)
    flipped_ = true;
  else
    next_row_ = staged_row_;
}

void load_stage::finish(const commit_result& result) const {
  if (load_.done)
    load_.done(result);
}

} // namespace godwit::runtime
