#include "runtime/journal/journal_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include "runtime/journal/sqlite_error.hpp"

namespace godwit::runtime {

namespace {

using io::sqlite::database;
using io::sqlite::open_mode;
using nothing = tl::expected<void, journal_error>;

journal_error system_error(const std::string& file, int number, const std::string& doing) {
  return from_sqlite(
      {.code = SQLITE_IOERR, .extended = SQLITE_IOERR, .system_errno = number, .message = std::strerror(number)}, file,
      doing);
}

// Size in bytes; nothing where there is no file. Looks without opening: closing a descriptor of the database file would
// drop SQLite's locks on it in this process.
std::optional<std::int64_t> size_of(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0)
    return std::nullopt;
  return static_cast<std::int64_t>(info.st_size);
}

// Looks at the files before SQLite does, because SQLite takes an empty file for a new database.
nothing check_presence(const std::string& path, bool create) {
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0) {
    if (!S_ISREG(info.st_mode))
      return tl::unexpected(foreign_file(path, "not a regular file"));
    if (info.st_size == 0)
      return tl::unexpected(foreign_file(path, "the file is empty"));
    return {};
  }
  if (errno != ENOENT)
    return tl::unexpected(system_error(path, errno, "looking for it"));
  for (const auto* suffix : {"-wal", "-journal"})
    if (size_of(path + suffix).value_or(0) > 0)
      return tl::unexpected(journal_error{journal_errc::missing, path,
                                          "the file is gone, but " + path + suffix + " is still there",
                                          "Put the file back beside it, or move " + path + suffix + " away too."});
  if (!create)
    return tl::unexpected(journal_error{journal_errc::missing, path, "there is no such file",
                                        "Name the right file; godwitd makes it at its first start."});
  return {};
}

nothing sync_folder_of(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int number = errno;
  if (descriptor >= 0)
    ::close(descriptor);
  if (!synced)
    return tl::unexpected(system_error(path, number, "syncing its folder"));
  return {};
}

nothing make_tables(const std::string& file, const std::string& path, const std::string& vfs) {
  auto db = database::open(file, {.mode = open_mode::read_write, .vfs = vfs});
  if (!db)
    return tl::unexpected(from_sqlite(db.error(), path, "making it"));
  // A rollback journal, so that everything is in the one file when it is moved into place.
  const auto setup = "PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL; PRAGMA application_id = " +
                     std::to_string(journal_application_id);
  if (auto done = db->exec(setup); !done)
    return tl::unexpected(from_sqlite(done.error(), path, "making it"));
  if (auto done = migrate(*db, path, {}); !done)
    return done;
  return check_identity(*db, path);
}

nothing make_new(const file_options& options) {
  const auto draft = options.path + ".new";
  for (const auto* suffix : {"", "-journal", "-wal", "-shm"})
    ::unlink((draft + suffix).c_str());
  const int descriptor = ::open(draft.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0)
    return tl::unexpected(system_error(options.path, errno, "making it"));
  ::close(descriptor);
  if (auto made = make_tables(draft, options.path, options.vfs); !made)
    return made;
  if (::rename(draft.c_str(), options.path.c_str()) != 0)
    return tl::unexpected(system_error(options.path, errno, "moving it into place"));
  return sync_folder_of(options.path);
}

nothing set_up_writing(database& db, const std::string& path) {
  const auto mode = db.query_text("PRAGMA journal_mode = WAL");
  if (!mode)
    return tl::unexpected(from_sqlite(mode.error(), path, "switching to a write-ahead log"));
  if (*mode != "wal")
    return tl::unexpected(journal_error{journal_errc::io, path, "the file system refuses a write-ahead log",
                                        "Put the journal on a local disk; network file systems lack shared memory."});
  // Checkpoints run between commits when the writer says so. The log shrinks again after a reader held it open for
  // long. temp_store in memory: no third place where the disk can be full.
  auto done = db.exec("PRAGMA synchronous = FULL; PRAGMA wal_autocheckpoint = 0; PRAGMA temp_store = MEMORY; "
                      "PRAGMA journal_size_limit = 67108864; PRAGMA foreign_keys = ON");
  if (!done)
    return tl::unexpected(from_sqlite(done.error(), path, "setting it up"));
  return {};
}

// Counts this run; it proves too that the file can be written before anybody relies on it.
nothing count_run(database& db, const std::string& path) {
  if (auto done = db.exec("UPDATE meta SET value = value + 1 WHERE name = 'run'"); !done)
    return tl::unexpected(from_sqlite(done.error(), path, "counting this run"));
  return {};
}

} // namespace

nothing make_folder_of(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  if (folder.empty())
    return {};
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure)
    return tl::unexpected(
        journal_error{failure == std::errc::no_space_on_device ? journal_errc::disk_full : journal_errc::read_only,
                      path, "the folder can not be made (" + failure.message() + ")",
                      "Make the folder " + folder.string() + " and give this user the right to write."});
  return {};
}

nothing check_integrity(database& db, const std::string& file, integrity_check check) {
  if (check == integrity_check::none)
    return {};
  const auto verdict =
      db.query_text(check == integrity_check::full ? "PRAGMA integrity_check(1)" : "PRAGMA quick_check(1)");
  if (!verdict)
    return tl::unexpected(from_sqlite(verdict.error(), file, "checking it"));
  if (*verdict != "ok")
    return tl::unexpected(corrupt_file(file, *verdict));
  return {};
}

tl::expected<database, journal_error> open_for_writing(const file_options& options) {
  const auto& path = options.path;
  if (auto present = check_presence(path, options.create); !present)
    return tl::unexpected(std::move(present.error()));
  if (!size_of(path))
    if (auto made = make_new(options); !made)
      return tl::unexpected(std::move(made.error()));
  auto db = database::open(path, {.mode = open_mode::read_write, .vfs = options.vfs});
  if (!db)
    return tl::unexpected(from_sqlite(db.error(), path, "opening it"));
  if (db->read_only())
    return tl::unexpected(from_sqlite({.code = SQLITE_READONLY,
                                       .extended = SQLITE_READONLY,
                                       .system_errno = 0,
                                       .message = "it opens for reading only"},
                                      path, "opening it"));
  const auto checked =
      check_identity(*db, path).and_then([&] { return check_tables(*db, path, options.tables); }).and_then([&] {
        return check_integrity(*db, path, options.check);
      });
  if (!checked)
    return tl::unexpected(checked.error());
  const auto ready =
      set_up_writing(*db, path).and_then([&] { return migrate(*db, path, options.tables); }).and_then([&] {
        return count_run(*db, path);
      });
  if (!ready)
    return tl::unexpected(ready.error());
  return std::move(*db);
}

tl::expected<database, journal_error> open_for_reading(const std::string& path, const std::string& vfs) {
  if (auto present = check_presence(path, false); !present)
    return tl::unexpected(std::move(present.error()));
  const auto open = [&](open_mode mode) -> tl::expected<database, journal_error> {
    auto db = database::open(path, {.mode = mode, .vfs = vfs});
    if (!db)
      return tl::unexpected(from_sqlite(db.error(), path, "opening it"));
    if (auto ours = check_identity(*db, path); !ours)
      return tl::unexpected(std::move(ours.error()));
    return std::move(*db);
  };
  auto db = open(open_mode::read_only);
  const bool helped = db || db.error().code == journal_errc::foreign || db.error().code == journal_errc::newer ||
                      db.error().code == journal_errc::corrupt;
  // In a folder that can not be written SQLite can not make the -shm file. Without a log nobody writes and nothing is
  // missing from the database file, so it can be read as it stands.
  if (!helped && size_of(path + "-wal").value_or(0) == 0)
    return open(open_mode::immutable);
  return db;
}

} // namespace godwit::runtime
