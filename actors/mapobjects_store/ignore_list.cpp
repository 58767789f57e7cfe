#include "actors/mapobjects_store/ignore_list.hpp"

#include "actors/domain/geo/mgrs.hpp"
#include "actors/mapobjects_store/geo_point.hpp"
#include "actors/mapobjects_store/input_check.hpp"
#include "actors/mapobjects_store/object_table.hpp"
#include "messages/mapobjects_store/delivery.hpp"

namespace godwit::mapobjects_store {

namespace {

// Also one that was orphaned since: a verdict that comes again must not be taken for a new one.
map_result<std::optional<ignored_item>> known_item(map_tables& t, const std::string& id) {
  return t.q.first("SELECT id, mission_id, mgrs_cell, class_group, since_ns FROM ignored_item "
                   "WHERE id = ?1 AND generation = 0 UNION ALL "
                   "SELECT id, mission_id, mgrs_cell, class_group, since_ns FROM orphaned_ignored_item WHERE id = ?1",
                   ignored_item_of, id);
}

} // namespace

ignored_item ignored_item_of(const sql::row& row) {
  return {.id = row.text(0),
          .mission_id = row.text(1),
          .mgrs_cell = row.text(2),
          .class_group = row.text(3),
          .since_ns = row.integer(4)};
}

map_result<bool> is_ignored(map_tables& t, const geo_position& at, const std::string& class_group) {
  const auto cells = geo::mgrs_cells(point_of(at));
  auto found = t.q.first(
      "SELECT 1 FROM ignored_item WHERE mgrs_cell IN (?1, ?2, ?3, ?4, ?5) AND class_group = ?6 "
      "AND (generation = ?7 OR generation = 0 AND (number > ?8 OR delivery != 'delivered'))",
      [](sql::row&) { return true; }, cells[0], cells[1], cells[2], cells[3], cells[4], class_group,
      t.map.shown_generation(), t.map.pulled_ignored_item);
  if (!found)
    return tl::unexpected(std::move(found.error()));
  return found->has_value();
}

map_result<std::optional<ignored_item>> judge(map_tables& t, const operator_verdict& said) {
  if (auto sound = check(said); !sound)
    return tl::unexpected(std::move(sound.error()));
  if (said.said != verdict::declined)
    return std::optional<ignored_item>();
  auto known = known_item(t, said.id);
  if (!known || *known)
    return known;
  const ignored_item item{.id = said.id,
                          .mission_id = said.mission_id,
                          .mgrs_cell = geo::mgrs_cell(point_of(said.position), t.rules.ignored_cell),
                          .class_group = said.class_group,
                          .since_ns = said.at_ns};
  auto done =
      t.q.run("INSERT INTO ignored_item(id, generation, mission_id, mgrs_cell, class_group, since_ns, delivery) "
              "VALUES (?, 0, ?, ?, ?, ?, ?)",
              item.id, item.mission_id, item.mgrs_cell, item.class_group, item.since_ns, delivery_state::pending);
  if (!done)
    return tl::unexpected(std::move(done.error()));
  return std::optional(item);
}

} // namespace godwit::mapobjects_store
