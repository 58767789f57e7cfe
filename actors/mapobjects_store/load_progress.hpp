// The load that is under way: what of it has come, and where its rows are to lie. Only in memory: a load does not
// outlive the process, whose successor begins anew.
//
// Thread: the one of the database.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "actors/domain/uuid/uuid.hpp"

namespace godwit::mapobjects_store {

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
  std::int64_t ignored_items = 0; // that have come

  void give_up() { *this = {}; }
};

} // namespace godwit::mapobjects_store
