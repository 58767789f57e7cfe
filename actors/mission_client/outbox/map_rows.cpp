#include "actors/mission_client/outbox/map_rows.hpp"

#include "actors/domain/mission/utc_text.hpp"

namespace godwit::mission_client {

namespace {

mission::observation_kind kind_of(mapobjects_store::observation_kind what) {
  switch (what) {
  case mapobjects_store::observation_kind::found:
    return mission::observation_kind::fresh;
  case mapobjects_store::observation_kind::moved:
    return mission::observation_kind::moved;
  case mapobjects_store::observation_kind::existing:
    return mission::observation_kind::existing;
  case mapobjects_store::observation_kind::ignored:
    return mission::observation_kind::ignored;
  case mapobjects_store::observation_kind::removed_candidate:
    break;
  }
  return mission::observation_kind::removed_candidate;
}

// The store names a new object after the observation that found it; for the service it has no name yet.
std::optional<std::string> object_of(const mapobjects_store::observation& seen) {
  return seen.kind == mapobjects_store::observation_kind::found ? std::nullopt : seen.object_id;
}

tl::unexpected<std::string> no_time(const std::string& text) {
  return tl::unexpected("\"" + text + "\" is no time that this program can hold");
}

} // namespace

mission::observation_batch observations_of(const mapobjects_store::batch& rows) {
  mission::observation_batch result{rows.key, {}};
  result.observations.reserve(rows.observations.size());
  for (const auto& each : rows.observations)
    result.observations.push_back({each.id, object_of(each), kind_of(each.kind), each.class_group,
                                   each.position.latitude_deg, each.position.longitude_deg, each.position.altitude_m,
                                   each.confidence, mission::utc_text(each.at_ns)});
  return result;
}

mission::ignored_item_batch ignored_items_of(const mapobjects_store::batch& rows) {
  mission::ignored_item_batch result{rows.key, {}};
  result.ignored_items.reserve(rows.ignored_items.size());
  for (const auto& each : rows.ignored_items)
    result.ignored_items.push_back({each.id, each.mgrs_cell, each.class_group, mission::utc_text(each.since_ns)});
  return result;
}

rows_result<mapobjects_store::map_object> objects_of(const mission::map_object_page& page,
                                                     const std::string& mission_id) {
  std::vector<mapobjects_store::map_object> result;
  result.reserve(page.map_objects.size());
  for (const auto& each : page.map_objects) {
    const auto first = mission::time_of_utc_text(each.first_seen);
    if (!first)
      return no_time(each.first_seen);
    const auto last = mission::time_of_utc_text(each.last_seen);
    if (!last)
      return no_time(each.last_seen);
    result.push_back({each.object_id,
                      mission_id,
                      each.class_group,
                      {each.latitude, each.longitude, each.altitude_m},
                      *first,
                      *last,
                      each.confidence});
  }
  return result;
}

rows_result<mapobjects_store::ignored_item> ignored_items_of(const mission::ignored_item_page& page,
                                                             const std::string& mission_id) {
  std::vector<mapobjects_store::ignored_item> result;
  result.reserve(page.ignored_items.size());
  for (const auto& each : page.ignored_items) {
    const auto since = mission::time_of_utc_text(each.at);
    if (!since)
      return no_time(each.at);
    result.push_back({each.ignored_id, mission_id, each.mgrs_cell, each.class_group, *since});
  }
  return result;
}

} // namespace godwit::mission_client
