#include "io/sqlite/store_file.hpp"

#include <array>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/sqlite/bus_guard.hpp"
#include "io/sqlite/database.hpp"

namespace godwit::io::sqlite {

namespace {

using nothing = store_result<void>;

std::int64_t newest(const store_format& format) { return static_cast<std::int64_t>(format.migrations.size()); }

// Size in bytes; nothing where there is no file. Looks without opening: closing a descriptor of the database file would
// drop SQLite's locks on it in this process.
std::optional<std::int64_t> size_of(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0)
    return std::nullopt;
  return static_cast<std::int64_t>(info.st_size);
}

// Looks at the files before SQLite does, because SQLite takes an empty file for a new database.
nothing check_presence(const store_kind& kind, const std::string& path, bool create) {
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0) {
    if (!S_ISREG(info.st_mode))
      return tl::unexpected(foreign_file(kind, path, "not a regular file"));
    if (info.st_size == 0)
      return tl::unexpected(foreign_file(kind, path, "the file is empty"));
    return {};
  }
  if (errno != ENOENT)
    return tl::unexpected(system_error(kind, path, errno, "looking for it"));
  for (const auto* suffix : {"-wal", "-journal"})
    if (size_of(path + suffix).value_or(0) > 0)
      return tl::unexpected(store_error{store_errc::missing, path,
                                        "the file is gone, but " + path + suffix + " is still there",
                                        "Put the file back beside it, or move " + path + suffix + " away too"});
  if (!create)
    return tl::unexpected(store_error{store_errc::missing, path, "there is no such file",
                                      "Name the right file; godwitd makes it at its first start"});
  return {};
}

nothing make_folder_of(const store_kind& kind, const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  std::error_code failure;
  if (!folder.empty() && std::filesystem::create_directories(folder, failure))
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, failure); // for this user alone
  if (failure)
    return tl::unexpected(
        store_error{failure == std::errc::no_space_on_device ? store_errc::disk_full : store_errc::read_only, path,
                    "the folder of the " + kind.name + " can not be made (" + failure.message() + ")",
                    "Make the folder " + folder.string() + " and give this user the right to write"});
  return {};
}

nothing sync_folder_of(const store_kind& kind, const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int number = errno;
  if (descriptor >= 0)
    ::close(descriptor);
  if (!synced)
    return tl::unexpected(system_error(kind, path, number, "syncing its folder"));
  return {};
}

// Refuses what is foreign, newer or damaged at the first look; the version otherwise. Only reads.
store_result<std::int64_t> check_identity(database& db, const store_format& format, const std::string& file) {
  const auto application = db.query_integer("PRAGMA application_id");
  if (!application)
    return tl::unexpected(describe(application.error(), format.kind, file, "reading its header"));
  if (*application != format.application_id)
    return tl::unexpected(foreign_file(format.kind, file, "an SQLite database of another program"));
  const auto version = db.query_integer(format.read_version);
  if (!version && is_programming_error(version.error()))
    return tl::unexpected(corrupt_file(format.kind, file, "it has no version: " + version.error().message));
  if (!version)
    return tl::unexpected(describe(version.error(), format.kind, file, "reading its version"));
  if (*version > newest(format))
    return tl::unexpected(newer_file(format.kind, file, "the " + format.kind.name, *version, newest(format)));
  if (*version < 1)
    return tl::unexpected(corrupt_file(format.kind, file, "its version is " + std::to_string(*version)));
  return *version;
}

nothing migrate(database& db, const store_format& format, const std::string& file, std::int64_t found) {
  if (found == newest(format))
    return {};
  const auto version = std::to_string(newest(format));
  if (auto done = run_migrations(db, format.migrations, found, format.set_version + version); !done)
    return tl::unexpected(describe(done.error(), format.kind, file, "moving its tables to version " + version));
  return {};
}

nothing make_tables(const store_format& format, const store_options& options, const std::string& draft) {
  auto db = database::open(draft, {.mode = open_mode::read_write, .vfs = options.vfs});
  if (!db)
    return tl::unexpected(describe(db.error(), format.kind, options.path, "making it"));
  // A rollback journal, so that everything is in the one file when it is moved into place.
  const auto setup = "PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL; PRAGMA application_id = " +
                     std::to_string(format.application_id);
  if (auto done = db->exec(setup); !done)
    return tl::unexpected(describe(done.error(), format.kind, options.path, "making it"));
  if (auto done = migrate(*db, format, options.path, 0); !done)
    return done;
  return check_identity(*db, format, options.path).map([](std::int64_t) {});
}

nothing make_new(const store_format& format, const store_options& options) {
  const auto draft = options.path + ".new";
  for (const auto* suffix : {"", "-journal", "-wal", "-shm"})
    ::unlink((draft + suffix).c_str());
  const int descriptor = ::open(draft.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0)
    return tl::unexpected(system_error(format.kind, options.path, errno, "making it"));
  ::close(descriptor);
  if (auto made = make_tables(format, options, draft); !made)
    return made;
  if (::rename(draft.c_str(), options.path.c_str()) != 0)
    return tl::unexpected(system_error(format.kind, options.path, errno, "moving it into place"));
  return sync_folder_of(format.kind, options.path);
}

nothing set_up_writing(database& db, const store_format& format, const std::string& path) {
  const auto mode = db.query_text("PRAGMA journal_mode = WAL");
  if (!mode)
    return tl::unexpected(describe(mode.error(), format.kind, path, "switching to a write-ahead log"));
  if (*mode != "wal")
    return tl::unexpected(
        store_error{store_errc::io, path, "the file system refuses a write-ahead log",
                    "Put the " + format.kind.name + " on a local disk; network file systems lack shared memory"});
  // The writer says when checkpoints run. The log shrinks again after a reader held it open for long. temp_store in
  // memory: no third place where the disk can be full.
  auto done = db.exec("PRAGMA synchronous = FULL; PRAGMA wal_autocheckpoint = 0; PRAGMA temp_store = MEMORY; "
                      "PRAGMA journal_size_limit = 67108864; " +
                      format.settings);
  if (!done)
    return tl::unexpected(describe(done.error(), format.kind, path, "setting it up"));
  return {};
}

store_result<database> open_existing(const store_format& format, const store_options& options) {
  const auto& path = options.path;
  auto db = database::open(path, {.mode = open_mode::read_write, .vfs = options.vfs});
  if (!db)
    return tl::unexpected(describe(db.error(), format.kind, path, "opening it"));
  if (db->read_only())
    return tl::unexpected(describe({.code = SQLITE_READONLY,
                                    .extended = SQLITE_READONLY,
                                    .system_errno = 0,
                                    .message = "it opens for reading only"},
                                   format.kind, path, "opening it"));
  const auto found = check_identity(*db, format, path);
  if (!found)
    return tl::unexpected(found.error());
  const auto inspected = options.inspect ? options.inspect(*db) : nothing{};
  const auto ready = inspected.and_then([&] { return check_integrity(*db, format.kind, path, options.check); })
                         .and_then([&] { return set_up_writing(*db, format, path); })
                         .and_then([&] { return migrate(*db, format, path, *found); });
  if (!ready)
    return tl::unexpected(ready.error());
  return std::move(*db);
}

} // namespace

nothing check_integrity(database& db, const store_kind& kind, const std::string& file, integrity_check check) {
  if (check == integrity_check::none)
    return {};
  const auto verdict =
      db.query_text(check == integrity_check::full ? "PRAGMA integrity_check(1)" : "PRAGMA quick_check(1)");
  if (!verdict)
    return tl::unexpected(describe(verdict.error(), kind, file, "checking it"));
  if (*verdict != "ok")
    return tl::unexpected(corrupt_file(kind, file, *verdict));
  return {};
}

store_result<store_file> open_for_writing(const store_format& format, const store_options& options) {
  if (auto made = make_folder_of(format.kind, options.path); !made)
    return tl::unexpected(std::move(made.error()));
  auto lock = lock_file::acquire(format.kind, options.path);
  if (!lock)
    return tl::unexpected(std::move(lock.error()));
  if (auto present = check_presence(format.kind, options.path, options.create); !present)
    return tl::unexpected(std::move(present.error()));
  if (!size_of(options.path))
    if (auto made = make_new(format, options); !made)
      return tl::unexpected(std::move(made.error()));
  if (auto held = lock->hold(format.kind, options.path); !held)
    return tl::unexpected(std::move(held.error()));
  guard_against_bus_errors();
  auto db = open_existing(format, options);
  if (!db)
    return tl::unexpected(std::move(db.error()));
  return store_file{std::move(*lock), std::move(*db)};
}

store_result<database> open_for_reading(const store_format& format, const std::string& path, const std::string& vfs) {
  if (auto present = check_presence(format.kind, path, false); !present)
    return tl::unexpected(std::move(present.error()));
  const auto open = [&](open_mode mode) -> store_result<database> {
    auto db = database::open(path, {.mode = mode, .vfs = vfs});
    if (!db)
      return tl::unexpected(describe(db.error(), format.kind, path, "opening it"));
    if (auto ours = check_identity(*db, format, path); !ours)
      return tl::unexpected(std::move(ours.error()));
    return std::move(*db);
  };
  auto db = open(open_mode::read_only);
  // In a folder that can not be written SQLite can not make the -shm file. Without a log nobody writes and nothing is
  // missing from the database file, so it can be read as it stands.
  if (!db && may_pass(db.error().code) && size_of(path + "-wal").value_or(0) == 0)
    return open(open_mode::immutable);
  return db;
}

result<void> run_migrations(database& db, const std::vector<std::string>& steps, std::int64_t found,
                            const std::string& set_version) {
  auto change = transaction::begin(db);
  if (!change)
    return tl::unexpected(std::move(change.error()));
  for (auto i = static_cast<std::size_t>(found); i < steps.size(); ++i)
    if (auto done = db.exec(steps[i]); !done)
      return done;
  if (auto done = db.exec(set_version); !done)
    return done;
  return change->commit();
}

namespace {

std::string holder_of(int descriptor) {
  std::array<char, 32> text{};
  const auto size = ::pread(descriptor, text.data(), text.size() - 1, 0);
  std::string pid(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  while (!pid.empty() && pid.back() == '\n')
    pid.pop_back();
  return pid.empty() ? "of unknown id" : pid;
}

} // namespace

store_result<lock_file> lock_file::acquire(const store_kind& kind, const std::string& path) {
  const auto doing = "making the lock file " + path + ".lock";
  const int descriptor = ::open((path + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0)
    return tl::unexpected(system_error(kind, path, errno, doing));
  lock_file held(descriptor);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK)
      return tl::unexpected(system_error(kind, path, errno, doing));
    return tl::unexpected(store_error{store_errc::locked, path,
                                      "process " + holder_of(descriptor) + " writes this " + kind.name + " already",
                                      "End that process, or give this one another " + kind.name});
  }
  // The id is for people; the lock holds without it, so a full disk here is no reason to stop.
  const auto pid = std::to_string(::getpid()) + "\n";
  if (::ftruncate(descriptor, 0) == 0)
    static_cast<void>(::pwrite(descriptor, pid.data(), pid.size(), 0) == 0);
  return held;
}

store_result<void> lock_file::hold(const store_kind& kind, const std::string& path) {
  database_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (database_ < 0)
    return tl::unexpected(system_error(kind, path, errno, "opening it"));
  struct stat info {};
  if (::fstat(database_, &info) != 0)
    return tl::unexpected(system_error(kind, path, errno, "looking at it"));
  if (info.st_nlink > 1)
    return tl::unexpected(store_error{store_errc::foreign, path,
                                      "the file has " + std::to_string(info.st_nlink) +
                                          " names (hard links), and each would have a log of its own",
                                      "Remove the other names, or make a copy for them"});
  if (::flock(database_, LOCK_EX | LOCK_NB) == 0)
    return {};
  if (errno != EWOULDBLOCK)
    return tl::unexpected(system_error(kind, path, errno, "locking it"));
  return tl::unexpected(store_error{store_errc::locked, path,
                                    "another process writes this " + kind.name + " already, under another name",
                                    "End that process, or give this one another " + kind.name});
}

lock_file::lock_file(lock_file&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), database_(std::exchange(other.database_, -1)) {}

lock_file& lock_file::operator=(lock_file&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(database_, other.database_);
  return *this;
}

lock_file::~lock_file() { release(); }

void lock_file::release() {
  for (auto* each : {&database_, &descriptor_}) {
    if (*each >= 0)
      ::close(*each);
    *each = -1;
  }
}

} // namespace godwit::io::sqlite
