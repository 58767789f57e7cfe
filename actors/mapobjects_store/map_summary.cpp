#include "actors/mapobjects_store/map_summary.hpp"

#include "actors/mapobjects_store/deliveries.hpp"

namespace godwit::mapobjects_store {

map_result<map_status> summary(map_tables& t) {
  const auto& map = t.map;
  const auto seen_here = t.q.first(
      "SELECT count(*) FROM seen_object WHERE number > ?",
      [](sql::row& row) { return static_cast<std::uint64_t>(row.integer(0)); }, map.pulled_observation);
  if (!seen_here)
    return tl::unexpected(seen_here.error());
  const auto missions = all_owed(t.q);
  if (!missions)
    return tl::unexpected(missions.error());
  map_status found;
  found.mission_id = map.mission_id;
  found.sync = map.sync;
  found.pulled_mission_id = map.pulled_mission_id;
  if (!map.pulled_mission_id.empty()) {
    found.pulled_ns = map.pulled_ns;
    found.objects = static_cast<std::uint64_t>(map.last_object - map.first_object + 1);
    found.ignored_items = static_cast<std::uint64_t>(map.ignored_items);
  }
  found.seen_here = seen_here->value_or(0);
  found.loading = t.load.generation;
  for (const auto& each : *missions) {
    found.pending += each.pending;
    found.taken += each.taken;
    found.orphaned += each.orphaned;
  }
  return found;
}

} // namespace godwit::mapobjects_store
