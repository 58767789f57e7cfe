#include "actors/mapobjects_store/map_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "actors/mapobjects_store/schema.hpp"
#include "actors/mapobjects_store/sqlite_error.hpp"

namespace godwit::mapobjects_store {

namespace {

using io::sqlite::database;
using io::sqlite::open_mode;
using done_or_not = map_result<void>;

map_error disk_error(const std::string& what, int number) {
  return {map_errc::disk, what + " (" + std::strerror(number) + ")",
          "Make sure that there is space and that this user may write the file and its folder"};
}

// Looks before SQLite does, because SQLite takes an empty file for a new database. True: it is there.
map_result<bool> is_present(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0) {
    if (S_ISREG(info.st_mode) && info.st_size > 0)
      return true;
    return tl::unexpected(map_error{map_errc::foreign, path + " is empty or not a regular file",
                                    "Name another file for the map, or move this one away if nobody needs it"});
  }
  if (errno != ENOENT)
    return tl::unexpected(disk_error(path + " can not be looked at", errno));
  if (::stat((path + "-wal").c_str(), &info) == 0 && info.st_size > 0)
    return tl::unexpected(map_error{map_errc::missing, path + " is gone, but " + path + "-wal is still there",
                                    "Put the file back beside it, or move the -wal file away too"});
  return false;
}

done_or_not make_tables(const std::string& draft, const std::string& vfs) {
  auto db = database::open(draft, {.mode = open_mode::read_write, .vfs = vfs});
  if (!db)
    return tl::unexpected(from_sqlite(db.error(), "making " + draft));
  // A rollback journal, so that everything is in the one file when it is moved into place.
  const auto setup = "PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL; PRAGMA application_id = " +
                     std::to_string(map_application_id);
  if (auto done = db->exec(setup); !done)
    return tl::unexpected(from_sqlite(done.error(), "making " + draft));
  return migrate_schema(*db);
}

done_or_not sync_folder_of(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int number = errno;
  if (descriptor >= 0)
    ::close(descriptor);
  if (!synced)
    return tl::unexpected(disk_error("the folder of " + path + " can not be synced", number));
  return {};
}

done_or_not make_new(const map_file_options& options) {
  const auto draft = options.path + ".new";
  for (const auto* suffix : {"", "-journal", "-wal", "-shm"})
    ::unlink((draft + suffix).c_str());
  const int descriptor = ::open(draft.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0)
    return tl::unexpected(disk_error(options.path + " can not be made", errno));
  ::close(descriptor);
  if (auto made = make_tables(draft, options.vfs); !made)
    return made;
  if (::rename(draft.c_str(), options.path.c_str()) != 0)
    return tl::unexpected(disk_error(options.path + " can not be moved into place", errno));
  return sync_folder_of(options.path);
}

done_or_not check_pages(database& db, const std::string& file) {
  const auto verdict = db.query_text("PRAGMA quick_check(1)");
  if (!verdict)
    return tl::unexpected(from_sqlite(verdict.error(), "checking " + file));
  if (*verdict != "ok")
    return tl::unexpected(map_error{map_errc::corrupt, file + " is damaged (" + *verdict + ")",
                                    "Move it away together with its -wal file; the map itself is pulled again"});
  return {};
}

done_or_not set_up_writing(database& db, const std::string& file) {
  const auto mode = db.query_text("PRAGMA journal_mode = WAL");
  if (!mode)
    return tl::unexpected(from_sqlite(mode.error(), "switching " + file + " to a write-ahead log"));
  if (*mode != "wal")
    return tl::unexpected(map_error{map_errc::disk, "the file system of " + file + " refuses a write-ahead log",
                                    "Put the map on a local disk"});
  // Checkpoints run when the writer says so. The cache holds the inner pages of a million objects and some leaves.
  // Deleted rows need not be overwritten: nothing on the map is secret, and it would write each page of garbage.
  auto done = db.exec("PRAGMA synchronous = FULL; PRAGMA wal_autocheckpoint = 0; PRAGMA temp_store = MEMORY; "
                      "PRAGMA journal_size_limit = 67108864; PRAGMA cache_size = -32768; PRAGMA secure_delete = OFF");
  if (!done)
    return tl::unexpected(from_sqlite(done.error(), "setting up " + file));
  return {};
}

} // namespace

done_or_not make_folder_of(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  std::error_code failure;
  if (!folder.empty())
    std::filesystem::create_directories(folder, failure);
  if (failure)
    return tl::unexpected(disk_error("the folder of " + path + " can not be made", failure.value()));
  return {};
}

map_result<database> open_map_for_writing(const map_file_options& options) {
  const auto& path = options.path;
  const auto present = is_present(path);
  if (!present)
    return tl::unexpected(present.error());
  if (!*present && !options.create)
    return tl::unexpected(map_error{map_errc::missing, "there is no " + path, "Name the right file"});
  if (!*present)
    if (auto made = make_new(options); !made)
      return tl::unexpected(std::move(made.error()));
  auto db = database::open(path, {.mode = open_mode::read_write, .vfs = options.vfs});
  if (!db)
    return tl::unexpected(from_sqlite(db.error(), "opening " + path));
  const auto ready = check_schema(*db, path)
                         .and_then([&] { return options.check_pages ? check_pages(*db, path) : done_or_not{}; })
                         .and_then([&] { return set_up_writing(*db, path); })
                         .and_then([&] { return migrate_schema(*db); });
  if (!ready)
    return tl::unexpected(ready.error());
  return std::move(*db);
}

map_result<database> open_map_for_reading(const std::string& path, const std::string& vfs) {
  const auto present = is_present(path);
  if (!present)
    return tl::unexpected(present.error());
  if (!*present)
    return tl::unexpected(map_error{map_errc::missing, "there is no " + path, "Name the right file"});
  auto db = database::open(path, {.mode = open_mode::read_only, .vfs = vfs});
  if (!db)
    return tl::unexpected(from_sqlite(db.error(), "opening " + path));
  if (auto ours = check_schema(*db, path); !ours)
    return tl::unexpected(std::move(ours.error()));
  return std::move(*db);
}

} // namespace godwit::mapobjects_store
