#include "actors/mapobjects_store/map_load.hpp"

#include <algorithm>

#include "actors/domain/geo/hilbert.hpp"
#include "actors/mapobjects_store/input_check.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/mission_scope.hpp"
#include "actors/mapobjects_store/object_table.hpp"
#include "messages/mapobjects_store/delivery.hpp"

namespace godwit::mapobjects_store {

namespace {

map_result<std::int64_t> number_from(sql& q, const char* text) {
  auto number = q.first(text, [](sql::row& row) { return row.integer(0); });
  if (!number)
    return tl::unexpected(std::move(number.error()));
  return number->value_or(0);
}

// Everything up to this number has been delivered, or never will be.
constexpr const char* delivered_observations =
    "SELECT coalesce(min(number) - 1, (SELECT max(number) FROM observation), 0) FROM "
    "(SELECT min(number) AS number FROM observation WHERE delivery = 'pending' "
    "UNION ALL SELECT min(number) FROM observation WHERE batch IS NOT NULL)";
constexpr const char* delivered_ignored_items =
    "SELECT coalesce(min(number) - 1, (SELECT max(number) FROM ignored_item), 0) FROM "
    "(SELECT min(number) AS number FROM ignored_item WHERE delivery = 'pending' "
    "UNION ALL SELECT min(number) FROM ignored_item WHERE batch IS NOT NULL)";
constexpr const char* next_object = "SELECT coalesce(max(number), 0) + 1 FROM loaded_object";

map_result<void> put_object(map_tables& t, const map_object& object) {
  if (auto sound = check(object); !sound)
    return sound;
  if (object.mission_id != t.load.mission_id)
    return refused("object " + object.id + " is not of the mission that is loaded");
  if (t.load.objects.size() >= max_load_objects)
    return refused("a load has at most " + std::to_string(max_load_objects) + " objects");
  const auto number = t.load.first_object + static_cast<std::int64_t>(t.load.objects.size());
  t.load.objects.push_back({.id = ids::bits_of(object.id),
                            .number = number,
                            .latitude_deg = object.position.latitude_deg,
                            .longitude_deg = object.position.longitude_deg,
                            .on_curve = geo::hilbert_place(point_of(object.position))});
  return add_loaded(t.q, object, number);
}

map_result<void> put_ignored(map_tables& t, const ignored_item& given) {
  const auto item = checked(given);
  if (!item)
    return tl::unexpected(item.error());
  const auto twice = t.q.first(
      "SELECT 1 FROM ignored_item WHERE generation = ? AND id = ?", [](sql::row&) { return true; }, t.load.generation,
      item->id);
  if (!twice)
    return tl::unexpected(twice.error());
  if (*twice)
    return refused("ignored item " + item->id + " comes twice");
  ++t.load.ignored_items;
  return t.q.run("INSERT INTO ignored_item(id, generation, mission_id, mgrs_cell, class_group, since_ns, delivery) "
                 "VALUES (?, ?, ?, ?, ?, ?, ?)",
                 item->id, t.load.generation, item->mission_id, item->mgrs_cell, item->class_group, item->since_ns,
                 delivery_state::delivered);
}

} // namespace

map_result<begun_load> begin(map_tables& t, const begin_load& asked) {
  if (auto sound = check_id(asked.mission_id, "mission_id"); !sound)
    return tl::unexpected(std::move(sound.error()));
  auto observations = number_from(t.q, delivered_observations);
  if (!observations)
    return tl::unexpected(std::move(observations.error()));
  auto ignored_items = number_from(t.q, delivered_ignored_items);
  if (!ignored_items)
    return tl::unexpected(std::move(ignored_items.error()));
  auto first_object = number_from(t.q, next_object);
  if (!first_object)
    return tl::unexpected(std::move(first_object.error()));
  t.load.give_up();
  t.load.generation = ++t.map.last_generation;
  t.load.mission_id = asked.mission_id;
  t.load.observation = *observations;
  t.load.ignored_item = *ignored_items;
  t.load.first_object = *first_object;
  const bool has_copy = t.map.has_copy() && t.map.pulled_mission_id == asked.mission_id;
  return save_map_row(t.q, t.map).map([&] {
    return begun_load{t.load.generation, has_copy ? t.map.pulled_mark : std::string()};
  });
}

map_result<void> check_under_way(const map_tables& t, std::int64_t load) {
  if (load == 0 || load != t.load.generation)
    return tl::unexpected(
        map_error{map_errc::load_given_up, "load " + std::to_string(load) + " is not under way", "Begin a new one"});
  return {};
}

map_result<void> page_stage::check(map_tables& t) const {
  const auto rows = page_.objects.size() + page_.ignored.size() + page_.removed.size();
  for (const auto& each : page_.removed)
    if (auto sound = check_id(each, "removed"); !sound)
      return sound;
  if (rows > max_page_rows)
    return refused("a page has " + std::to_string(rows) + " rows, " + std::to_string(max_page_rows) + " are possible");
  if (page_.number > t.load.next_page)
    return refused("page " + std::to_string(page_.number) + " came, the next one is " +
                   std::to_string(t.load.next_page));
  return {};
}

// To what is committed of this page: the turn before this one may have been rolled back.
void page_stage::go_back(load_progress& load) {
  if (load_ == nullptr) {
    load_ = &load;
    objects_before_ = load.objects.size();
    ignored_before_ = load.ignored_items;
    removed_before_ = load.removed.size();
  }
  const auto objects = std::min(next_row_, page_.objects.size());
  load.objects.resize(objects_before_ + objects);
  load.removed.resize(removed_before_);
  for (const auto& each : page_.removed)
    load.removed.push_back(ids::bits_of(each));
  load.ignored_items = ignored_before_ + static_cast<std::int64_t>(next_row_ - objects);
  staged_row_ = next_row_;
}

map_result<void> page_stage::put(map_tables& t, std::size_t row) {
  const auto objects = page_.objects.size();
  return row < objects ? put_object(t, page_.objects[row]) : put_ignored(t, page_.ignored[row - objects]);
}

map_result<bool> page_stage::stage(map_tables& t, decision_context& now) {
  if (auto under_way = check_under_way(t, page_.load); !under_way)
    return tl::unexpected(std::move(under_way.error()));
  if (page_.number < t.load.next_page && load_ == nullptr)
    return true;
  if (auto possible = check(t); !possible)
    return tl::unexpected(std::move(possible.error()));
  go_back(t.load);
  t.load.next_page = page_.number + 1; // the same again after a rollback
  const auto rows = page_.objects.size() + page_.ignored.size();
  while (staged_row_ < rows) {
    if (auto done = put(t, staged_row_); !done)
      return tl::unexpected(std::move(done.error()));
    ++staged_row_;
    if (now.over_after_row())
      break;
  }
  return staged_row_ == rows;
}

void page_stage::finish(const map_result<void>& result) {
  if (!result && load_ != nullptr && load_->generation == page_.load)
    load_->give_up();
  done_(result);
}

// Before the first row: whether all is there.
map_result<void> load_finish::check(map_tables& t) {
  auto& load = t.load;
  const auto objects = static_cast<std::int64_t>(load.objects.size());
  if (objects != asked_.objects || load.ignored_items != asked_.ignored)
    return refused("load " + std::to_string(asked_.load) + " has " + std::to_string(objects) + " objects and " +
                   std::to_string(load.ignored_items) + " ignored items, announced were " +
                   std::to_string(asked_.objects) + " and " + std::to_string(asked_.ignored));
  if (asked_.is_change && (!t.map.has_copy() || t.map.pulled_mission_id != load.mission_id))
    return refused("load " + std::to_string(asked_.load) + " has what has changed in a copy that is not there");
  for (const auto& each : load.objects)
    changed_.push_back(each.id);
  std::sort(changed_.begin(), changed_.end());
  const auto twice = std::adjacent_find(changed_.begin(), changed_.end());
  if (twice != changed_.end()) {
    auto error = refused("object " + ids::text_of(*twice) + " comes twice");
    load.give_up();
    return error;
  }
  is_taken_over_ = !asked_.is_change;
  if (is_taken_over_) {
    changed_ = {};
    sort_along_curve(load);
  } else {
    changed_.insert(changed_.end(), load.removed.begin(), load.removed.end());
    std::sort(changed_.begin(), changed_.end());
    objects_ = load.objects.size();
    last_ = t.map.first_object - 1;
  }
  load_ = &load;
  return {};
}

// Row by row: the copy from before is shown until the end, and is garbage after it.
map_result<bool> load_finish::take_over(map_tables& t, decision_context& now) {
  auto& load = t.load;
  load.objects.resize(objects_); // the turn before this one may have been rolled back
  staged_last_ = last_;
  std::vector<stored_object> rows;
  auto read = t.q.each(
      "SELECT number, id, class_group, latitude_deg, longitude_deg, altitude_m, first_seen_ns, last_seen_ns, "
      "confidence, ?3 FROM loaded_object WHERE number > ?1 AND number <= ?2 ORDER BY number LIMIT ?4",
      [&](sql::row& row) { rows.push_back(object_of(row, true)); }, last_, t.map.last_object, load.mission_id,
      static_cast<std::int64_t>(max_chunk_rows));
  if (!read)
    return tl::unexpected(std::move(read.error()));
  for (const auto& each : rows) {
    const auto id = ids::bits_of(each.what.id);
    if (!std::binary_search(changed_.begin(), changed_.end(), id))
      if (auto put = put_object(t, each.what); !put)
        return tl::unexpected(std::move(put.error()));
    staged_last_ = each.number;
    if (now.over_after_row())
      break;
  }
  return rows.empty();
}

// Neighbours after each other, so that a node of the tree is touched while it is filled and not again.
void load_finish::sort_along_curve(load_progress& load) {
  std::sort(load.objects.begin(), load.objects.end(),
            [](const loaded_place& a, const loaded_place& b) { return a.on_curve < b.on_curve; });
}

map_result<bool> load_finish::stage(map_tables& t, decision_context& now) {
  if (asked_.load == t.map.generation && asked_.load != 0)
    return true; // it has been done
  auto ready =
      check_under_way(t, asked_.load).and_then([&] { return load_ != nullptr ? map_result<void>{} : check(t); });
  if (ready && !is_taken_over_) {
    auto all = take_over(t, now);
    if (!all)
      return tl::unexpected(std::move(all.error()));
    takes_last_ = *all;
    return false;
  }
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
  if (load_ != nullptr && !is_taken_over_) {
    objects_ = load_->objects.size();
    last_ = staged_last_;
    is_taken_over_ = takes_last_;
    if (is_taken_over_)
      sort_along_curve(*load_);
    return;
  }
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
  map.last_object = t.load.first_object + static_cast<std::int64_t>(t.load.objects.size()) - 1;
  map.ignored_items = asked_.ignored;
  map.mission_id = t.load.mission_id;
  map.pulled_mission_id = t.load.mission_id;
  map.pulled_ns = asked_.at_ns;
  map.pulled_mark = asked_.mark;
  map.pulled_observation = t.load.observation;
  map.pulled_ignored_item = t.load.ignored_item;
  map.sync = next_state(map.sync, sync_event::pull_finished, map.has_copy());
  return save_map_row(t.q, map);
}

} // namespace godwit::mapobjects_store
