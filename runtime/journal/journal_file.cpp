#include "runtime/journal/journal_file.hpp"

#include <filesystem>

#include "runtime/journal/sqlite_error.hpp"

namespace godwit::runtime {

namespace {

using io::sqlite::database;
using io::sqlite::store_result;

// Counts this run; it proves too that the file can be written before anybody relies on it.
store_result<void> count_run(database& db, const std::string& path) {
  if (auto done = db.exec("UPDATE meta SET value = value + 1 WHERE name = 'run'"); !done)
    return tl::unexpected(io::sqlite::describe(done.error(), journal_format().kind, path, "counting this run"));
  return {};
}

} // namespace

std::string journal_in_use(const std::string& path) {
  constexpr int most_rescues = 4;
  auto result = path;
  std::error_code ignored;
  for (int i = 0; i < most_rescues && std::filesystem::exists(result + rescued_suffix, ignored); ++i)
    result += rescued_suffix;
  return result;
}

tl::expected<io::sqlite::store_file, journal_error> open_for_writing(const file_options& options) {
  auto opened = io::sqlite::open_for_writing(
      journal_format(), {.path = options.path,
                         .vfs = options.vfs,
                         .create = options.create,
                         .check = options.check,
                         .inspect = [&](database& db) { return check_tables(db, options.path, options.tables); }});
  if (!opened)
    return tl::unexpected(from_store(opened.error()));
  const auto ready = migrate_tables(opened->db, options.path, options.tables).and_then([&] {
    return count_run(opened->db, options.path);
  });
  if (!ready)
    return tl::unexpected(from_store(ready.error()));
  return std::move(*opened);
}

tl::expected<database, journal_error> open_for_reading(const std::string& path, const std::string& vfs) {
  return io::sqlite::open_for_reading(journal_format(), path, vfs).map_error(from_store);
}

tl::expected<void, journal_error> check_integrity(database& db, const std::string& file, integrity_check check) {
  return io::sqlite::check_integrity(db, journal_format().kind, file, check).map_error(from_store);
}

} // namespace godwit::runtime
