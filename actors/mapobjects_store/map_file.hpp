// Opening the map's file. Thread: the caller's; blocks on the disk.
#pragma once

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

} // namespace godwit::mapobjects_store
