// Opening the map's file. Thread: the caller's; blocks on the disk.
#pragma once

#include <cstdint>
#include <string>

#include "actors/mapobjects_store/error.hpp"
#include "io/sqlite/store_file.hpp"

namespace godwit::mapobjects_store {

struct map_file_options {
  std::string path = {};
  std::string vfs = {};     // empty = SQLite's default; tests inject faults with it
  bool create = true;       // false: a map that is not there is an error
  bool check_pages = false; // reads the whole file, some 300 MB for a million objects; for tools and after a crash of
                            // the machine. Without it damage is found when a page is read.
};

[[nodiscard]] map_result<io::sqlite::store_file> open_map_for_writing(const map_file_options& options);

// Any number, beside a writer.
[[nodiscard]] map_result<io::sqlite::database> open_map_for_reading(const std::string& path,
                                                                    const std::string& vfs = {});

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
inline constexpr std::int32_t map_application_id = 0x676f646d; // "godm"

[[nodiscard]] const io::sqlite::store_format& map_format();

} // namespace godwit::mapobjects_store
