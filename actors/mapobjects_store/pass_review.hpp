// The end of a pass, in turns: what was in view and not seen becomes an observation.
//
// Not missed are: objects of class groups that were not looked for, what is on the ignore list, and what was seen since
// the pass started, be it after its end. What is in view is read on a connection of its own, from the map as it was
// when the review began; each object is looked at again before it is missed, and one of a map that was replaced
// meanwhile is not. The id of a missing follows from those of
// pass and object: a review that is done again misses nothing twice. Thread: the writer's.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "actors/mapobjects_store/staged_work.hpp"
#include "actors/mapobjects_store/view_cursor.hpp"
#include "messages/mapobjects_store/pass.hpp"

namespace godwit::mapobjects_store {

class pass_review final : public staged_work {
public:
  using callback = std::function<void(const map_result<pass_reviewed>&)>;

  // A pass that was checked.
  pass_review(pass_end pass, view_cursor in_view, callback done);

  [[nodiscard]] map_result<bool> stage(map_tables& t, decision_context& now) override;
  void committed() override;
  [[nodiscard]] bool must_be_synced() const override { return true; }
  void finish(const map_result<void>& result) override;

private:
  map_result<void> look_at(map_tables& t, const view_cursor::row& seen_then);
  map_result<void> miss(map_tables& t, const map_object& object);

  pass_end pass_;
  view_cursor in_view_;
  callback done_;
  std::vector<view_cursor::row> uncommitted_; // objects that come again when their transaction fails
  pass_reviewed staged_;
  pass_reviewed counts_;
};

} // namespace godwit::mapobjects_store
