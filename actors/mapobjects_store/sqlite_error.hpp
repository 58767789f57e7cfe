// Errors of the file in the map's words. Thread: any.
#pragma once

#include <string>

#include "actors/mapobjects_store/error.hpp"
#include "io/sqlite/store_error.hpp"

namespace godwit::mapobjects_store {

[[nodiscard]] map_error from_store(const io::sqlite::store_error& error);

// DOING completes the sentence "... while DOING".
[[nodiscard]] map_error from_sqlite(const io::sqlite::error& error, const std::string& doing);

} // namespace godwit::mapobjects_store
