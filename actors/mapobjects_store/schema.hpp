// The tables of the map's file and their version.
//
//   map               one row: which map is shown, how far it can be relied on
//   loaded_object     what the service gave: rows first_object to last_object are the map, others are a load that is
//                     under way or garbage
//   loaded_place_0/1  R*Trees over their places, one for what is shown, one for the next load; `number` is that of
//                     loaded_object
//   seen_object       what this vehicle found or moved itself; `number` is that of the observation
//   seen_place        R*Tree over their places
//   ignored_item      what is of no interest, by cell and class group; generation 0 = declined here, others = loads;
//                     also what is owed of it
//   observation       what was seen, in order; also what is owed of it
//   batch             keys under which rows were taken for delivery; rows name the number of their batch
//   orphaned_...      what is owed for missions that are gone, kept for people
//   schema_version    one row
//
// Thread: any.
#pragma once

#include <cstdint>

#include "io/sqlite/store_file.hpp"

namespace godwit::mapobjects_store {

inline constexpr std::int32_t map_application_id = 0x676f646d; // "godm"

[[nodiscard]] const io::sqlite::store_format& map_format();
[[nodiscard]] std::int64_t newest_schema_version();

} // namespace godwit::mapobjects_store
