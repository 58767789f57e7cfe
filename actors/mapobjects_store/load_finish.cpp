#include "actors/mapobjects_store/load_finish.hpp"

#include <algorithm>

#include "actors/mapobjects_store/map_load.hpp"
#include "actors/mapobjects_store/place_tree.hpp"
#include "actors/mapobjects_store/sync.hpp"

namespace godwit::mapobjects_store {

// Before the first row: whether all is there, and in which order it goes into the tree.
map_result<void> load_finish::prepare(map_tables& t) {
  auto& load = t.load;
  const auto objects = static_cast<std::int64_t>(load.objects.size());
  if (objects != asked_.objects || load.ignored_items != asked_.ignored)
    return refused("load " + std::to_string(asked_.load) + " has " + std::to_string(objects) + " objects and " +
                   std::to_string(load.ignored_items) + " ignored items, announced were " +
                   std::to_string(asked_.objects) + " and " + std::to_string(asked_.ignored));
  const auto by_id = [](const loaded_place& a, const loaded_place& b) { return a.id < b.id; };
  std::sort(load.objects.begin(), load.objects.end(), by_id);
  const auto twice = std::adjacent_find(load.objects.begin(), load.objects.end(),
                                        [](const loaded_place& a, const loaded_place& b) { return a.id == b.id; });
  if (twice != load.objects.end()) {
    auto error = refused("object " + ids::text_of(twice->id) + " comes twice");
    load.give_up();
    return error;
  }
  std::sort(load.objects.begin(), load.objects.end(),
            [](const loaded_place& a, const loaded_place& b) { return a.on_curve < b.on_curve; });
  load_ = &load;
  return {};
}

map_result<bool> load_finish::stage(map_tables& t, decision_context& now) {
  if (asked_.load == t.map.generation && asked_.load != 0)
    return true; // it has been done
  auto ready =
      check_under_way(t, asked_.load).and_then([&] { return load_ != nullptr ? map_result<void>{} : prepare(t); });
  const auto tree = other_tree(t.map.tree);
  if (ready && !begun_)
    ready = clear_tree(t.q, tree);
  if (!ready)
    return tl::unexpected(std::move(ready.error()));
  staged_ = next_;
  if (must_be_synced())
    return become_the_map(t).map([] { return true; });
  while (staged_ < t.load.objects.size()) {
    if (auto done = add_place(t.q, tree, t.load.objects[staged_]); !done)
      return tl::unexpected(std::move(done.error()));
    ++staged_;
    if (now.over_after_row())
      break;
  }
  return false;
}

// All places are in the tree.
bool load_finish::must_be_synced() const { return begun_ && load_ != nullptr && next_ == load_->objects.size(); }

void load_finish::committed() {
  begun_ = true;
  next_ = staged_;
}

// Its places are not needed any more, or it has failed.
void load_finish::finish(const map_result<void>& result) {
  if (load_ != nullptr && load_->generation == asked_.load)
    load_->give_up();
  done_(result);
}

map_result<void> load_finish::become_the_map(map_tables& t) const {
  auto& map = t.map;
  map.tree = other_tree(map.tree);
  map.generation = t.load.generation;
  map.first_object = t.load.first_object;
  map.last_object = t.load.first_object + asked_.objects - 1;
  map.ignored_items = asked_.ignored;
  map.mission_id = t.load.mission_id;
  map.pulled_mission_id = t.load.mission_id;
  map.pulled_ns = asked_.at_ns;
  map.pulled_observation = t.load.observation;
  map.pulled_ignored_item = t.load.ignored_item;
  map.sync = next_state(map.sync, sync_event::pull_finished, map.has_copy());
  return save_map_row(t.q, map);
}

} // namespace godwit::mapobjects_store
