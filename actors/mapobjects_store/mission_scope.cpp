#include "actors/mapobjects_store/mission_scope.hpp"

#include "actors/mapobjects_store/input_check.hpp"
#include "actors/mapobjects_store/orphans.hpp"
#include "actors/mapobjects_store/sync.hpp"

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

} // namespace godwit::mapobjects_store
