// What every change of the map works on: its statements, its one row, the load under way, the rules. The caller holds a
// transaction.
//
// Thread: the one of the database.
#pragma once

#include "actors/mapobjects_store/load_progress.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/settings.hpp"

namespace godwit::mapobjects_store {

struct map_tables {
  sql& q;
  map_row& map; // as in the file; whoever changes it saves it in the same transaction
  load_progress& load;
  const settings& rules;
};

} // namespace godwit::mapobjects_store
