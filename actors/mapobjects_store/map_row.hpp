// The one row that says which map is shown and how far it can be relied on.
//
// What is shown: the objects and ignored items of the last load, as long as the chosen mission is the one that they
// were pulled for; and what was seen here with a number above `pulled_...`, because the load does not contain it.
// Changing this row replaces the whole map at once. Thread: plain value; load and save the one of the database.
#pragma once

#include <cstdint>
#include <string>

#include "actors/mapobjects_store/sql.hpp"
#include "messages/mapobjects_store/sync_state.hpp"

namespace godwit::mapobjects_store {

struct map_row {
  std::string mission_id; // chosen; empty = none
  sync_state sync = sync_state::fresh_boot;

  std::string pulled_mission_id; // what the last load was for; empty = there was none
  std::int64_t pulled_ns = 0;
  std::int64_t generation = 0;   // number of the last load
  std::int64_t first_object = 1; // its rows
  std::int64_t last_object = 0;
  std::int64_t ignored_items = 0;      // how many it has
  std::int64_t tree = 0;               // the tree that has its places
  std::int64_t pulled_observation = 0; // numbers up to these are contained in the load
  std::int64_t pulled_ignored_item = 0;
  std::int64_t last_generation = 0; // highest number ever used for a load

  [[nodiscard]] bool has_copy() const { return !pulled_mission_id.empty() && pulled_mission_id == mission_id; }
  // No row has the generation -1.
  [[nodiscard]] std::int64_t shown_generation() const { return has_copy() ? generation : -1; }
};

[[nodiscard]] map_result<map_row> load_map_row(sql& q);
[[nodiscard]] map_result<void> save_map_row(sql& q, const map_row& map);

} // namespace godwit::mapobjects_store
