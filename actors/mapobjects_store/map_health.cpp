#include "actors/mapobjects_store/map_health.hpp"

#include "actors/mapobjects_store/deliveries.hpp"
#include "actors/mapobjects_store/response_queue.hpp"

namespace godwit::mapobjects_store {

namespace {

std::string owed_text(const map_status& known) {
  std::string text;
  if (known.pending + known.taken > 0)
    text = "; " + std::to_string(known.pending + known.taken) + " rows to deliver";
  if (known.orphaned > 0)
    text += "; " + std::to_string(known.orphaned) + " rows of missions that are gone";
  return text;
}

} // namespace

runtime::condition health_of(const map_result<map_writer_status>& writer, const std::optional<map_status>& known) {
  if (!writer)
    return {failure_of(writer.error().code) == map_failure::busy ? runtime::health_colour::yellow
                                                                 : runtime::health_colour::red,
            writer.error().message()};
  if (writer->failing)
    return {runtime::health_colour::red, writer->reason};
  if (!known)
    return {};
  if (known->failure != map_failure::none)
    return {runtime::health_colour::red, known->error};
  const bool old_map = known->sync == sync_state::degraded || known->sync == sync_state::failed ||
                       known->sync == sync_state::cached_fallback;
  return {old_map || known->orphaned > 0 ? runtime::health_colour::yellow : runtime::health_colour::green,
          "map: " + std::string(io::name_of(known->sync)) + owed_text(*known)};
}

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
