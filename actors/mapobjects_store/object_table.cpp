#include "actors/mapobjects_store/object_table.hpp"

#include <tuple>

#include "actors/domain/geo/geodesic.hpp"

namespace godwit::mapobjects_store {

namespace {

// Parameters: the box, class group, pulled observation. The trees keep floats, rounded outwards.
constexpr const char* seen_in_box =
    "SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg, o.altitude_m, o.first_seen_ns, "
    "o.last_seen_ns, o.confidence, o.mission_id "
    "FROM seen_place b CROSS JOIN seen_object o ON o.number = b.number "
    "WHERE b.max_latitude_deg >= ?1 AND b.min_latitude_deg <= ?2 "
    "AND b.max_longitude_deg >= ?3 AND b.min_longitude_deg <= ?4 AND o.class_group = ?5 AND o.number > ?6";

// And the pulled mission.
constexpr by_tree loaded_in_box = {
    "SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg, o.altitude_m, o.first_seen_ns, "
    "o.last_seen_ns, o.confidence, ?7 "
    "FROM loaded_place_0 b CROSS JOIN loaded_object o ON o.number = b.number "
    "WHERE b.max_latitude_deg >= ?1 AND b.min_latitude_deg <= ?2 "
    "AND b.max_longitude_deg >= ?3 AND b.min_longitude_deg <= ?4 AND o.class_group = ?5 "
    "AND NOT EXISTS (SELECT 1 FROM seen_object h WHERE h.id = o.id AND h.number > ?6)",
    "SELECT o.number, o.id, o.class_group, o.latitude_deg, o.longitude_deg, o.altitude_m, o.first_seen_ns, "
    "o.last_seen_ns, o.confidence, ?7 "
    "FROM loaded_place_1 b CROSS JOIN loaded_object o ON o.number = b.number "
    "WHERE b.max_latitude_deg >= ?1 AND b.min_latitude_deg <= ?2 "
    "AND b.max_longitude_deg >= ?3 AND b.min_longitude_deg <= ?4 AND o.class_group = ?5 "
    "AND NOT EXISTS (SELECT 1 FROM seen_object h WHERE h.id = o.id AND h.number > ?6)"};

} // namespace

stored_object object_of(const sql::row& row, bool is_loaded) {
  stored_object found{.number = row.integer(0), .is_loaded = is_loaded, .what = {}};
  auto& what = found.what;
  what.id = row.text(1);
  what.class_group = row.text(2);
  what.position = {row.real(3), row.real(4), row.is_null(5) ? std::nullopt : std::optional(row.real(5))};
  what.first_seen_ns = row.integer(6);
  what.last_seen_ns = row.integer(7);
  what.confidence = row.real(8);
  what.mission_id = row.text(9);
  return found;
}

map_result<std::vector<stored_object>>
objects_in(sql& q, const map_row& map, const std::vector<geo::bounding_box>& boxes, const std::string& class_group) {
  std::vector<stored_object> found;
  for (const auto& box : boxes) {
    auto done = q.each(
        seen_in_box, [&](sql::row& row) { found.push_back(object_of(row, false)); }, box.south_deg, box.north_deg,
        box.west_deg, box.east_deg, class_group, map.pulled_observation);
    if (done && map.has_copy())
      done = q.each(
          of_tree(loaded_in_box, map.tree), [&](sql::row& row) { found.push_back(object_of(row, true)); },
          box.south_deg, box.north_deg, box.west_deg, box.east_deg, class_group, map.pulled_observation,
          map.pulled_mission_id);
    if (!done)
      return tl::unexpected(std::move(done.error()));
  }
  return found;
}

map_result<std::optional<stored_object>> object_with(sql& q, const map_row& map, const std::string& id,
                                                     std::int64_t loaded_number) {
  auto seen = q.first(
      "SELECT number, id, class_group, latitude_deg, longitude_deg, altitude_m, first_seen_ns, last_seen_ns, "
      "confidence, mission_id FROM seen_object WHERE id = ? AND number > ?",
      [](sql::row& row) { return object_of(row, false); }, id, map.pulled_observation);
  if (!seen || *seen || !map.has_copy() || loaded_number < map.first_object || loaded_number > map.last_object)
    return seen;
  return q.first(
      "SELECT number, id, class_group, latitude_deg, longitude_deg, altitude_m, first_seen_ns, last_seen_ns, "
      "confidence, ?3 FROM loaded_object WHERE number = ?1 AND id = ?2",
      [](sql::row& row) { return object_of(row, true); }, loaded_number, id, map.pulled_mission_id);
}

map_result<void> add_loaded(sql& q, const map_object& object, std::int64_t number) {
  const auto& at = object.position;
  return q.run("INSERT INTO loaded_object VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", number, object.id, object.class_group,
               at.latitude_deg, at.longitude_deg, at.altitude_m, object.first_seen_ns, object.last_seen_ns,
               object.confidence);
}

map_result<void> put_seen(sql& q, const map_object& object, std::int64_t number) {
  const auto before = q.first(
      "SELECT number FROM seen_object WHERE id = ?", [](sql::row& row) { return row.integer(0); }, object.id);
  if (!before)
    return tl::unexpected(before.error());
  if (*before)
    if (auto removed = remove_seen(q, **before); !removed)
      return removed;
  const auto& at = object.position;
  return q
      .run("INSERT INTO seen_object VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", number, object.id, object.mission_id,
           object.class_group, at.latitude_deg, at.longitude_deg, at.altitude_m, object.first_seen_ns,
           object.last_seen_ns, object.confidence)
      .and_then([&] {
        return q.run("INSERT INTO seen_place VALUES (?1, ?2, ?2, ?3, ?3)", number, at.latitude_deg, at.longitude_deg);
      });
}

map_result<void> remove_seen(sql& q, std::int64_t number) {
  return q.run("DELETE FROM seen_place WHERE number = ?", number).and_then([&] {
    return q.run("DELETE FROM seen_object WHERE number = ?", number);
  });
}

map_result<void> note_seen_again(sql& q, const stored_object& object, std::int64_t at_ns) {
  return q.run(object.is_loaded ? "UPDATE loaded_object SET last_seen_ns = max(last_seen_ns, ?) WHERE number = ?"
                                : "UPDATE seen_object SET last_seen_ns = max(last_seen_ns, ?) WHERE number = ?",
               at_ns, object.number);
}

namespace {

constexpr by_tree any_place = {"SELECT number FROM loaded_place_0 LIMIT 1",
                               "SELECT number FROM loaded_place_1 LIMIT 1"};
constexpr by_tree drop = {"DROP TABLE loaded_place_0", "DROP TABLE loaded_place_1"};
constexpr by_tree create = {"CREATE VIRTUAL TABLE loaded_place_0 USING rtree(number, min_latitude_deg, "
                            "max_latitude_deg, min_longitude_deg, max_longitude_deg)",
                            "CREATE VIRTUAL TABLE loaded_place_1 USING rtree(number, min_latitude_deg, "
                            "max_latitude_deg, min_longitude_deg, max_longitude_deg)"};
constexpr by_tree insert = {"INSERT INTO loaded_place_0 VALUES (?1, ?2, ?2, ?3, ?3)",
                            "INSERT INTO loaded_place_1 VALUES (?1, ?2, ?2, ?3, ?3)"};

} // namespace

map_result<void> clear_tree(sql& q, std::int64_t tree) {
  const auto any = q.first(of_tree(any_place, tree), [](sql::row& row) { return row.integer(0); });
  if (!any)
    return tl::unexpected(any.error());
  if (!*any)
    return {};
  return q.run(of_tree(drop, tree)).and_then([&] { return q.run(of_tree(create, tree)); });
}

map_result<void> add_place(sql& q, std::int64_t tree, const loaded_place& place) {
  return q.run(of_tree(insert, tree), place.number, place.latitude_deg, place.longitude_deg);
}

std::optional<match> nearest_match(const geo::point& seen_at, std::span<const candidate> candidates,
                                   const settings& rules) {
  std::optional<match> best;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double distance_m = geo::distance_m(seen_at, candidates[i].at);
    if (distance_m > rules.match_within_m)
      continue;
    const bool better =
        !best || std::tie(distance_m, candidates[i].id) < std::tie(best->distance_m, candidates[best->index].id);
    if (better)
      best = match{i, distance_m};
  }
  return best;
}

observation_kind kind_of(const std::optional<match>& found, bool ignored, const settings& rules) {
  if (ignored)
    return observation_kind::ignored;
  if (!found)
    return observation_kind::found;
  return found->distance_m > rules.moved_above_m ? observation_kind::moved : observation_kind::existing;
}

bool is_finding(observation_kind kind) {
  return kind == observation_kind::found || kind == observation_kind::moved ||
         kind == observation_kind::removed_candidate;
}

} // namespace godwit::mapobjects_store
