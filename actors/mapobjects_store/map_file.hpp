// Opening the map's file: what is there, is it ours, is it whole. Never an empty start over existing data.
//
// A new map is made under the name PATH.new and moved into place when it is complete and on the disk: a file at PATH
// that is empty or can not be read is an error and not a beginning. Thread: the caller's; blocks on the disk.
#pragma once

#include <string>

#include "actors/mapobjects_store/error.hpp"
#include "io/sqlite/database.hpp"

namespace godwit::mapobjects_store {

struct map_file_options {
  std::string path = {};
  std::string vfs = {};     // empty = SQLite's default; tests inject faults with it
  bool create = true;       // false: a map that is not there is an error
  bool check_pages = false; // reads the whole file, some 300 MB for a million objects; for tools and after a crash of
                            // the machine. Without it damage is found when a page is read.
};

// The folder is there afterwards.
[[nodiscard]] map_result<void> make_folder_of(const std::string& path);

// The caller holds the lock file. The connection is in WAL mode with synchronous FULL.
[[nodiscard]] map_result<io::sqlite::database> open_map_for_writing(const map_file_options& options);

// Any number, beside a writer.
[[nodiscard]] map_result<io::sqlite::database> open_map_for_reading(const std::string& path,
                                                                    const std::string& vfs = {});

} // namespace godwit::mapobjects_store
