#include "actors/mapobjects_store/map_row.hpp"

namespace godwit::mapobjects_store {

map_result<map_row> load_map_row(sql& q) {
  auto found =
      q.first("SELECT mission_id, sync_state, pulled_mission_id, pulled_ns, generation, first_object, last_object, "
              "ignored_items, tree, pulled_observation, pulled_ignored_item, last_generation, "
              "pulled_mark FROM map",
              [](sql::row& row) {
                return map_row{.mission_id = row.text(0),
                               .sync = io::value_of<sync_state>(row.text(1)).value_or(sync_state::failed),
                               .pulled_mission_id = row.text(2),
                               .pulled_ns = row.integer(3),
                               .generation = row.integer(4),
                               .first_object = row.integer(5),
                               .last_object = row.integer(6),
                               .ignored_items = row.integer(7),
                               .tree = row.integer(8),
                               .pulled_observation = row.integer(9),
                               .pulled_ignored_item = row.integer(10),
                               .last_generation = row.integer(11),
                               .pulled_mark = row.text(12)};
              });
  if (!found)
    return tl::unexpected(std::move(found.error()));
  if (!*found)
    return tl::unexpected(map_error{map_errc::corrupt, "the table map has no row",
                                    "Move the file away together with its -wal file; the map itself is pulled again"});
  return std::move(**found);
}

map_result<void> save_map_row(sql& q, const map_row& map) {
  return q.run("UPDATE map SET mission_id = ?, sync_state = ?, pulled_mission_id = ?, pulled_ns = ?, generation = ?, "
               "first_object = ?, last_object = ?, ignored_items = ?, tree = ?, pulled_observation = ?, "
               "pulled_ignored_item = ?, last_generation = ?, pulled_mark = ?",
               map.mission_id, map.sync, map.pulled_mission_id, map.pulled_ns, map.generation, map.first_object,
               map.last_object, map.ignored_items, map.tree, map.pulled_observation, map.pulled_ignored_item,
               map.last_generation, map.pulled_mark);
}

} // namespace godwit::mapobjects_store
