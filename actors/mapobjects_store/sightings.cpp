#include "actors/mapobjects_store/sightings.hpp"

#include <algorithm>

#include "actors/domain/geo/mgrs.hpp"
#include "actors/mapobjects_store/deliveries.hpp"
#include "actors/mapobjects_store/input_check.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/mission_scope.hpp"
#include "actors/mapobjects_store/object_table.hpp"
#include "messages/mapobjects_store/delivery.hpp"

namespace godwit::mapobjects_store {

namespace {

struct known_match {
  stored_object object;
  match found;
};

map_result<std::optional<known_match>> find_match(map_tables& t, const sighting& seen) {
  const auto at = point_of(seen.position);
  auto near = objects_in(t.q, t.map, geo::boxes_around(at, t.rules.match_within_m), seen.class_group);
  if (!near)
    return tl::unexpected(std::move(near.error()));
  std::vector<candidate> candidates;
  for (const auto& each : *near)
    candidates.push_back({each.what.id, point_of(each.what.position)});
  const auto found = nearest_match(at, candidates, t.rules);
  if (!found)
    return std::optional<known_match>();
  return std::optional(known_match{std::move((*near)[found->index]), *found});
}

// The cell of the object counts beside that of the sighting: positions scatter, and an object that was declined at the
// rim of a cell would come back as the neighbour's.
map_result<bool> is_unwanted(map_tables& t, const sighting& seen, const std::optional<known_match>& known) {
  auto ignored = is_ignored(t, seen.position, seen.class_group);
  if (!ignored || *ignored || !known)
    return ignored;
  return is_ignored(t, known->object.what.position, seen.class_group);
}

map_object object_first_seen(const observation& what) {
  return {.id = what.id,
          .mission_id = what.mission_id,
          .class_group = what.class_group,
          .position = what.position,
          .first_seen_ns = what.at_ns,
          .last_seen_ns = what.at_ns,
          .confidence = what.confidence};
}

map_result<void> change_map(map_tables& t, const observation& what, std::int64_t number,
                            const std::optional<known_match>& known) {
  if (what.kind == observation_kind::found)
    return put_seen(t.q, object_first_seen(what), number);
  if (!known)
    return {};
  if (what.kind == observation_kind::moved) {
    auto moved = known->object.what;
    moved.mission_id = what.mission_id;
    moved.position = what.position;
    moved.last_seen_ns = std::max(moved.last_seen_ns, what.at_ns);
    moved.confidence = what.confidence;
    return put_seen(t.q, moved, number);
  }
  // The place of what stayed is left as it is: small errors would add up to a wandering object.
  return note_seen_again(t.q, known->object, what.at_ns);
}

observed answer(const map_tables& t, const observation& what) {
  return {what, is_finding(what.kind) && shows_findings(t.map.sync)};
}

} // namespace

map_result<observed> record(map_tables& t, const sighting& seen) {
  if (auto sound = check(seen); !sound)
    return tl::unexpected(std::move(sound.error()));
  const auto repeated = observation_with(t.q, seen.id);
  if (!repeated)
    return tl::unexpected(repeated.error());
  if (*repeated)
    return answer(t, **repeated);
  const auto known = find_match(t, seen);
  if (!known)
    return tl::unexpected(known.error());
  const auto unwanted = is_unwanted(t, seen, *known);
  if (!unwanted)
    return tl::unexpected(unwanted.error());

  const auto distance = *known ? std::optional((*known)->found) : std::nullopt;
  observation what{.id = seen.id,
                   .mission_id = seen.mission_id,
                   .object_id = std::nullopt,
                   .kind = kind_of(distance, *unwanted, t.rules),
                   .class_group = seen.class_group,
                   .position = seen.position,
                   .at_ns = seen.at_ns,
                   .confidence = seen.confidence};
  if (*known)
    what.object_id = (*known)->object.what.id;
  else if (what.kind == observation_kind::found)
    what.object_id = what.id;
  const auto number = add_observation(t.q, what);
  if (!number)
    return tl::unexpected(number.error());
  if (auto changed = change_map(t, what, *number, *known); !changed)
    return tl::unexpected(std::move(changed.error()));
  return answer(t, what);
}

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
