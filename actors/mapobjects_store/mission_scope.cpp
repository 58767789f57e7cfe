#include "actors/mapobjects_store/mission_scope.hpp"

#include "actors/mapobjects_store/input_check.hpp"

namespace godwit::mapobjects_store {

namespace {

map_result<void> move_on(map_tables& t, sync_event happened) {
  t.map.sync = next_state(t.map.sync, happened, t.map.has_copy());
  return save_map_row(t.q, t.map);
}

map_result<void> check_chosen(const map_tables& t, const std::string& mission_id) {
  return check_id(mission_id, "mission_id").and_then([&]() -> map_result<void> {
    if (t.map.mission_id != mission_id)
      return refused("mission " + mission_id + " is not the chosen one (" +
                     (t.map.mission_id.empty() ? "there is none" : t.map.mission_id) + ")");
    return {};
  });
}

map_result<void> remove_what_was_seen_for(map_tables& t, const std::string& mission_id) {
  for (const auto* each : {"DELETE FROM seen_place WHERE number IN "
                           "(SELECT number FROM seen_object WHERE mission_id = ?)",
                           "DELETE FROM seen_object WHERE mission_id = ?",
                           "DELETE FROM ignored_item WHERE mission_id = ? AND generation = 0"})
    if (auto done = t.q.run(each, mission_id); !done)
      return done;
  return {};
}

} // namespace

map_result<void> choose(map_tables& t, const choose_mission& asked) {
  if (auto sound = check_id(asked.mission_id, "mission_id"); !sound)
    return sound;
  if (t.map.mission_id == asked.mission_id)
    return {};
  t.map.mission_id = asked.mission_id;
  t.load.give_up();
  return move_on(t, sync_event::mission_chosen);
}

map_result<void> fall_back(map_tables& t, const pull_failed& said) {
  if (auto chosen = check_chosen(t, said.mission_id); !chosen)
    return chosen;
  t.load.give_up();
  return move_on(t, sync_event::pull_failed);
}

map_result<void> accept_fallback(map_tables& t, const acknowledge_fallback& said) {
  if (auto chosen = check_chosen(t, said.mission_id); !chosen)
    return chosen;
  if (t.map.sync != sync_state::degraded && t.map.sync != sync_state::cached_fallback)
    return refused("there is nothing to acknowledge: the map is " + std::string(io::name_of(t.map.sync)));
  return move_on(t, sync_event::fallback_acknowledged);
}

map_result<std::uint64_t> forget(map_tables& t, const delete_mission& said) {
  auto orphans = orphan(t, {said.mission_id, said.at_ns, said.reason});
  if (!orphans)
    return orphans;
  if (auto done = remove_what_was_seen_for(t, said.mission_id); !done)
    return tl::unexpected(std::move(done.error()));
  auto& map = t.map;
  if (t.load.mission_id == said.mission_id)
    t.load.give_up();
  if (map.pulled_mission_id == said.mission_id)
    map.pulled_mission_id.clear();
  const auto saved =
      map.mission_id == said.mission_id ? move_on(t, sync_event::mission_deleted) : save_map_row(t.q, t.map);
  if (!saved)
    return tl::unexpected(saved.error());
  return orphans;
}

sync_state next_state(sync_state now, sync_event happened, bool has_copy) {
  switch (happened) {
  case sync_event::mission_chosen:
  case sync_event::mission_deleted:
    return sync_state::fresh_boot;
  case sync_event::pull_finished:
    return sync_state::synced;
  case sync_event::pull_failed:
    return has_copy ? sync_state::degraded : sync_state::failed;
  case sync_event::fallback_acknowledged:
    return now == sync_state::degraded ? sync_state::cached_fallback : now;
  }
  return now;
}

bool shows_findings(sync_state now) { return now == sync_state::synced || now == sync_state::cached_fallback; }

namespace {

struct orphan_statements {
  const char* copy_to_orphans;
  const char* leave_queue;
  const char* requeue;
  const char* drop_requeued;
};

constexpr orphan_statements all_statements[] = {
    {.copy_to_orphans = "INSERT INTO orphaned_observation SELECT number, id, mission_id, object_id, kind, class_group, "
                        "latitude_deg, longitude_deg, altitude_m, at_ns, confidence, batch, ?2, ?3 "
                        "FROM observation WHERE mission_id = ?1 AND delivery IN ('pending', 'taken')",
     .leave_queue = "DELETE FROM observation WHERE mission_id = ? AND delivery IN ('pending', 'taken')",
     .requeue = "INSERT INTO observation SELECT number, id, mission_id, object_id, kind, class_group, latitude_deg, "
                "longitude_deg, altitude_m, at_ns, confidence, 'pending', NULL FROM orphaned_observation "
                "WHERE batch IS NULL AND (mission_id = ?1 OR ?1 = '')",
     .drop_requeued = "DELETE FROM orphaned_observation WHERE batch IS NULL AND (mission_id = ?1 OR ?1 = '')"},
    {.copy_to_orphans = "INSERT INTO orphaned_ignored_item SELECT number, id, mission_id, mgrs_cell, class_group, "
                        "since_ns, batch, ?2, ?3 FROM ignored_item "
                        "WHERE mission_id = ?1 AND delivery IN ('pending', 'taken')",
     .leave_queue = "UPDATE ignored_item SET delivery = 'orphaned', batch = NULL "
                    "WHERE mission_id = ? AND delivery IN ('pending', 'taken')",
     .requeue = "INSERT INTO ignored_item SELECT number, id, 0, mission_id, mgrs_cell, class_group, since_ns, "
                "'pending', NULL FROM orphaned_ignored_item WHERE batch IS NULL AND (mission_id = ?1 OR ?1 = '') "
                "ON CONFLICT DO UPDATE SET delivery = 'pending'",
     .drop_requeued = "DELETE FROM orphaned_ignored_item WHERE batch IS NULL AND (mission_id = ?1 OR ?1 = '')"}};

} // namespace

map_result<std::uint64_t> orphan(map_tables& t, const orphan_mission& asked) {
  if (auto sound = check_id(asked.mission_id, "mission_id"); !sound)
    return tl::unexpected(std::move(sound.error()));
  std::uint64_t rows = 0;
  for (const auto& each : all_statements) {
    auto done = t.q.run(each.copy_to_orphans, asked.mission_id, asked.at_ns, asked.reason);
    rows += static_cast<std::uint64_t>(t.q.changes());
    if (done)
      done = t.q.run(each.leave_queue, asked.mission_id);
    if (!done)
      return tl::unexpected(std::move(done.error()));
  }
  return t.q.run("UPDATE batch SET state = 'orphaned' WHERE mission_id = ? AND state = 'taken'", asked.mission_id)
      .map([&] { return rows; });
}

map_result<std::uint64_t> requeue(map_tables& t, const requeue_mission& asked) {
  std::uint64_t rows = 0;
  for (const auto& each : all_statements) {
    auto done =
        t.q.run(each.requeue, asked.mission_id).and_then([&] { return t.q.run(each.drop_requeued, asked.mission_id); });
    if (!done)
      return tl::unexpected(std::move(done.error()));
    rows += static_cast<std::uint64_t>(t.q.changes());
  }
  return rows;
}

} // namespace godwit::mapobjects_store
