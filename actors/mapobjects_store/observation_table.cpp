#include "actors/mapobjects_store/observation_table.hpp"

#include "messages/mapobjects_store/delivery.hpp"

namespace godwit::mapobjects_store {

observation observation_of(const sql::row& row) {
  observation what;
  what.id = row.text(0);
  what.mission_id = row.text(1);
  if (!row.is_null(2))
    what.object_id = row.text(2);
  what.kind = io::value_of<observation_kind>(row.text(3)).value_or(observation_kind::found);
  what.class_group = row.text(4);
  what.position = {row.real(5), row.real(6), row.is_null(7) ? std::nullopt : std::optional(row.real(7))};
  what.at_ns = row.integer(8);
  what.confidence = row.real(9);
  return what;
}

map_result<std::optional<observation>> observation_with(sql& q, const std::string& id) {
  return q.first("SELECT id, mission_id, object_id, kind, class_group, latitude_deg, longitude_deg, altitude_m, at_ns, "
                 "confidence FROM observation WHERE id = ?1 UNION ALL "
                 "SELECT id, mission_id, object_id, kind, class_group, latitude_deg, longitude_deg, altitude_m, at_ns, "
                 "confidence FROM orphaned_observation WHERE id = ?1",
                 observation_of, id);
}

map_result<std::int64_t> add_observation(sql& q, const observation& what) {
  const auto& at = what.position;
  return q
      .run("INSERT INTO observation(id, mission_id, object_id, kind, class_group, latitude_deg, longitude_deg, "
           "altitude_m, at_ns, confidence, delivery) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
           what.id, what.mission_id, what.object_id, what.kind, what.class_group, at.latitude_deg, at.longitude_deg,
           at.altitude_m, what.at_ns, what.confidence, delivery_state::pending)
      .and_then([&] { return q.inserted_number(); });
}

map_result<bool> was_seen(sql& q, const std::string& object_id, std::int64_t since_ns) {
  auto found = q.first(
      "SELECT 1 FROM observation WHERE object_id = ?1 AND at_ns >= ?2 AND kind != 'removed_candidate' "
      "UNION ALL SELECT 1 FROM orphaned_observation WHERE object_id = ?1 AND at_ns >= ?2 "
      "AND kind != 'removed_candidate'",
      [](sql::row&) { return true; }, object_id, since_ns);
  if (!found)
    return tl::unexpected(std::move(found.error()));
  return found->has_value();
}

} // namespace godwit::mapobjects_store
