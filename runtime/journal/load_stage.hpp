// One large load on its way: which rows come next, and when a chunk is long enough.
//
// Each call of stage runs inside a transaction of the caller's. `committed` moves on; without it the same rows come
// again, so a disk error costs nothing but time. The load's last transaction is its flip. Thread: the writer's.
#pragma once

#include <chrono>
#include <functional>

#include "runtime/journal/record_store.hpp"

namespace godwit::runtime {

struct chunk_limits {
  std::size_t max_rows = 1000;
  std::chrono::milliseconds max_time{20};
};

class load_stage {
public:
  load_stage(bulk_load load, chunk_limits limits) : load_(std::move(load)), limits_(limits) {}

  // URGENT is asked now and then; true ends the chunk early.
  [[nodiscard]] io::sqlite::result<void> stage(record_store& store, const std::function<bool()>& urgent);
  void committed();

  [[nodiscard]] bool complete() const { return flipped_; }
  [[nodiscard]] const std::string& name() const { return load_.name; }
  void finish(const commit_result& result) const;

private:
  void fetch();

  bulk_load load_;
  chunk_limits limits_;
  std::vector<row_change> chunk_;
  std::size_t next_row_ = 0;   // in the chunk, of those committed
  std::size_t staged_row_ = 0; // in the chunk, of those applied
  bool last_chunk_ = false;
  bool flipping_ = false;
  bool flipped_ = false;
};

} // namespace godwit::runtime
