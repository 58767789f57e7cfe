// The end of a load, in turns: its places are put into the tree that is not shown, and the last turn makes it the map.
//
// The tree is filled only now because then all places are known: put in along a curve, neighbours after each other,
// each node is touched while it is filled and not again. Thread: the writer's.
#pragma once

#include <functional>

#include "actors/mapobjects_store/staged_work.hpp"
#include "messages/mapobjects_store/load.hpp"

namespace godwit::mapobjects_store {

class load_finish final : public staged_work {
public:
  using callback = std::function<void(const map_result<void>&)>;

  load_finish(const finish_load& asked, callback done) : asked_(asked), done_(std::move(done)) {}

  // An object that comes twice ends the load; a wrong number of rows is refused.
  [[nodiscard]] map_result<bool> stage(map_tables& t, decision_context& now) override;
  void committed() override;
  [[nodiscard]] bool must_be_synced() const override; // only the last turn
  void finish(const map_result<void>& result) override;

private:
  [[nodiscard]] map_result<void> prepare(map_tables& t);
  [[nodiscard]] map_result<void> become_the_map(map_tables& t) const;

  finish_load asked_;
  callback done_;
  load_progress* load_ = nullptr; // once all was there
  bool begun_ = false;            // a turn was committed: the tree has what is counted by next_
  std::size_t next_ = 0;          // of the load's places: those before are in the tree
  std::size_t staged_ = 0;
};

} // namespace godwit::mapobjects_store
