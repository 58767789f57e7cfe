// A long job on the map, done in turns between the changes of others.
//
// Each call of `stage` runs inside a transaction of the caller's. `committed` moves on; without it the same rows come
// again, so that a disk error costs nothing but time. Thread: the writer's.
#pragma once

#include "actors/mapobjects_store/decision_context.hpp"
#include "actors/mapobjects_store/map_tables.hpp"

namespace godwit::mapobjects_store {

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
