// What every change of the map works on: its statements, its one row, the load under way, the rules. The caller holds a
// transaction.
//
// Thread: the one of the database.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "actors/domain/geo/mgrs.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "actors/mapobjects_store/map_row.hpp"

namespace godwit::mapobjects_store {

// What decides how sightings are understood. Thread: plain value.
struct settings {
  // A sighting within this distance of a known object of its class group is that object. Positions from the air are
  // good to some ten metres; things of one kind rarely stand closer than this to each other.
  double match_within_m = 30;

  // Below this a difference is the error of the measurement.
  double moved_above_m = 8;

  // What a decline covers: as large as the error of a position.
  geo::cell_size ignored_cell = geo::cell_size::m_10;
};

// The load that is under way: what of it has come, and where its rows are to lie. Only in memory: a load does not
// outlive the process, whose successor begins anew.
//
// Thread: the one of the database.

// Twice the largest map that was measured. One object takes some 50 bytes of memory until the load is finished.
inline constexpr std::size_t max_load_objects = 2'000'000;

struct loaded_place {
  ids::uuid_bits id;
  std::int64_t number = 0; // of the row
  double latitude_deg = 0;
  double longitude_deg = 0;
  std::uint64_t on_curve = 0; // rows are put into the tree in this order
};

struct load_progress {
  std::int64_t generation = 0; // number of the load; 0 = none
  std::string mission_id;
  std::int64_t observation = 0; // numbers up to these are contained in what the service gives
  std::int64_t ignored_item = 0;
  std::int64_t next_page = 0;
  std::int64_t first_object = 1; // number of its first row; the others follow without a gap
  std::vector<loaded_place> objects;
  std::vector<ids::uuid_bits> removed; // of the copy from before
  std::int64_t ignored_items = 0;      // that have come

  void give_up() { *this = {}; }
};

struct map_tables {
  sql& q;
  map_row& map; // as in the file; whoever changes it saves it in the same transaction
  load_progress& load;
  const settings& rules;
};

} // namespace godwit::mapobjects_store
