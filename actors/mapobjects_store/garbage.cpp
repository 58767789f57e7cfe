#include "actors/mapobjects_store/garbage.hpp"

#include <limits>
#include <vector>

#include "actors/mapobjects_store/object_table.hpp"

namespace godwit::mapobjects_store {

namespace {

// Rows that are only looked at cost far less than rows that are deleted: a turn looks at more of them, for about 0.5
// ms.
constexpr int rows_looked_at = 2000;

// Of neighbours in a table without indices, at once: some 5 ms.
constexpr int rows_deleted = 5000;

// SELECT gives number and whether it is garbage, in the order of numbers.
template <class... Values>
map_result<garbage_rows> rows_of(sql& q, const char* select, const Values&... values) {
  garbage_rows found;
  auto done = q.each(
      select,
      [&](sql::row& row) {
        found.last = row.integer(0);
        if (row.integer(1) != 0)
          found.garbage.push_back(found.last);
      },
      values..., rows_looked_at);
  if (!done)
    return tl::unexpected(std::move(done.error()));
  return found;
}

} // namespace

map_result<bool> garbage_collection::stage(map_tables& t, decision_context& now) {
  staged_ = next_;
  using step = map_result<bool> (garbage_collection::*)(map_tables&, decision_context&);
  static constexpr step steps[] = {&garbage_collection::loaded_objects, &garbage_collection::loaded_places,
                                   &garbage_collection::seen_objects, &garbage_collection::ignored_items,
                                   &garbage_collection::observations};
  auto clean = (this->*steps[staged_.table])(t, now);
  if (!clean)
    return clean;
  if (*clean)
    staged_ = {staged_.table + 1, 0};
  return staged_.table == static_cast<int>(std::size(steps));
}

// Rows in front of the shown ones and between them and the load under way. A copy for another mission than the chosen
// one is hidden and kept.
map_result<bool> garbage_collection::loaded_objects(map_tables& t, decision_context&) {
  const bool has_map = !t.map.pulled_mission_id.empty();
  const auto loading = t.load.generation == 0 ? std::numeric_limits<std::int64_t>::max() : t.load.first_object;
  const auto removed = t.q.run("DELETE FROM loaded_object WHERE number IN (SELECT number FROM loaded_object WHERE "
                               "number < ?1 ORDER BY number LIMIT ?2)",
                               has_map ? t.map.first_object : loading, rows_deleted);
  if (!removed)
    return tl::unexpected(removed.error());
  if (t.q.changes() == rows_deleted)
    return false;
  const auto given_up = t.q.run("DELETE FROM loaded_object WHERE number IN (SELECT number FROM loaded_object WHERE "
                                "number > ?1 AND number < ?2 ORDER BY number LIMIT ?3)",
                                has_map ? t.map.last_object : loading, loading, rows_deleted);
  if (!given_up)
    return tl::unexpected(given_up.error());
  return t.q.changes() < rows_deleted;
}

map_result<bool> garbage_collection::loaded_places(map_tables& t, decision_context&) {
  auto done = clear_tree(t.q, other_tree(t.map.tree));
  if (done && t.map.pulled_mission_id.empty())
    done = clear_tree(t.q, t.map.tree);
  return done.map([] { return true; });
}

// Deletes in order until the turn is over; true when the whole table is clean.
template <class Delete>
map_result<bool> garbage_collection::go_on(const map_result<garbage_rows>& found, decision_context& now,
                                           const Delete& remove) {
  if (!found)
    return tl::unexpected(found.error());
  if (found->last == 0)
    return true;
  for (const auto number : found->garbage) {
    if (auto done = remove(number); !done)
      return tl::unexpected(std::move(done.error()));
    if (now.over_after_row()) {
      staged_.number = number;
      return false;
    }
  }
  staged_.number = found->last;
  return false;
}

map_result<bool> garbage_collection::seen_objects(map_tables& t, decision_context& now) {
  const auto found = rows_of(t.q,
                             "SELECT number, 1 FROM seen_object WHERE number > ?1 AND number <= ?2 ORDER BY number "
                             "LIMIT ?3",
                             staged_.number, t.map.pulled_observation);
  return go_on(found, now, [&](std::int64_t number) { return remove_seen(t.q, number); });
}

map_result<bool> garbage_collection::ignored_items(map_tables& t, decision_context& now) {
  const auto found =
      rows_of(t.q,
              "SELECT number, NOT (generation = ?2 OR generation = ?3 OR generation = 0 AND (number > ?4 OR "
              "delivery != 'delivered')) FROM ignored_item WHERE number > ?1 ORDER BY number LIMIT ?5",
              staged_.number, t.map.pulled_mission_id.empty() ? -1 : t.map.generation,
              t.load.generation == 0 ? -1 : t.load.generation, t.map.pulled_ignored_item);
  return go_on(found, now,
               [&](std::int64_t number) { return t.q.run("DELETE FROM ignored_item WHERE number = ?", number); });
}

map_result<bool> garbage_collection::observations(map_tables& t, decision_context& now) {
  const auto found = rows_of(t.q,
                             "SELECT number, delivery = 'delivered' FROM observation WHERE number > ?1 AND number <= "
                             "(SELECT max(number) FROM observation) - ?2 ORDER BY number LIMIT ?3",
                             staged_.number, keep_delivered_);
  return go_on(found, now,
               [&](std::int64_t number) { return t.q.run("DELETE FROM observation WHERE number = ?", number); });
}

} // namespace godwit::mapobjects_store
