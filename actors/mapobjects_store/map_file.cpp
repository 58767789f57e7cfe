#include "actors/mapobjects_store/map_file.hpp"

#include "actors/mapobjects_store/schema.hpp"
#include "actors/mapobjects_store/sqlite_error.hpp"

namespace godwit::mapobjects_store {

map_result<io::sqlite::store_file> open_map_for_writing(const map_file_options& options) {
  using io::sqlite::integrity_check;
  const io::sqlite::store_options wanted{.path = options.path,
                                         .vfs = options.vfs,
                                         .create = options.create,
                                         .check = options.check_pages ? integrity_check::quick : integrity_check::none,
                                         .inspect = {}};
  return io::sqlite::open_for_writing(map_format(), wanted).map_error(from_store);
}

map_result<io::sqlite::database> open_map_for_reading(const std::string& path, const std::string& vfs) {
  return io::sqlite::open_for_reading(map_format(), path, vfs).map_error(from_store);
}

} // namespace godwit::mapobjects_store
