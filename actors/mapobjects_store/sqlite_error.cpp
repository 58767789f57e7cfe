#include "actors/mapobjects_store/sqlite_error.hpp"

#include <sqlite3.h>

namespace godwit::mapobjects_store {

map_error from_sqlite(const io::sqlite::error& error, const std::string& doing) {
  const auto detail = " (" + error.message + ", while " + doing + ")";
  if (error.code == SQLITE_CORRUPT)
    return {map_errc::corrupt, "the file is damaged" + detail,
            "Move it away together with its -wal file (the sqlite3 shell's .recover may save what was not delivered); "
            "the map itself is pulled again"};
  if (error.code == SQLITE_NOTADB)
    return {map_errc::foreign, "this is not a godwit map" + detail,
            "Name another file for the map, or move this one away if nobody needs it"};
  if (io::sqlite::is_programming_error(error))
    return {map_errc::internal, "a statement was refused" + detail,
            "This is a mistake in the program that gave the statement; please report it"};
  return {map_errc::disk, "the disk or another program is in the way" + detail,
          "Look for a full or failing disk and for programs that hold the file; a running godwit goes on by itself"};
}

} // namespace godwit::mapobjects_store
