// Opening a file that one program keeps: what is there, is it ours, is it whole. Never an empty start over existing
// data.
//
// The file carries an application id and a version; a version above the known ones is refused, because an older program
// must not write what it does not understand. A new file is made under the name PATH.new and moved into place when it
// is complete and on the disk: whatever lies at PATH was complete once, so a file there that is empty or can not be
// read is an error and not a beginning. What a crash leaves of PATH.new holds nothing that anybody was told of and is
// made anew. Thread: the caller's; blocks on the disk.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/sqlite/database.hpp"
#include "io/sqlite/store_error.hpp"

namespace godwit::io::sqlite {

// Tables move from version to version: step i leads from version i to i + 1.
//
// Thread: the one of the database.

// Runs the steps above FOUND and then SET_VERSION, in one transaction. A step may hold several statements.
[[nodiscard]] result<void> run_migrations(database& db, const std::vector<std::string>& steps, std::int64_t found,
                                          const std::string& set_version);

// One writer process: an advisory lock on a file of its own beside the database, with the holder's process id inside.
//
// A name is not the file: under a link, or without the lock file, another process would lock something else. So the
// database file itself is locked as well, by its inode, once it is there; a file with several names (hard links) is
// refused, because SQLite keeps a log for each name. The kernel gives the lock back when the process ends, however it
// ends. The file itself stays: removing it would let two processes hold "the" lock on two different files. It is a file
// of its own because closing any descriptor of the database file would drop the locks that SQLite holds on it in this
// process; for the same reason the descriptor of the database file that is held here is closed last. Thread: any; the
// object belongs to one. Source: flock(2).
class lock_file {
public:
  // PATH is the database's and is named in errors; the lock is PATH.lock.
  [[nodiscard]] static store_result<lock_file> acquire(const store_kind& kind, const std::string& path);

  lock_file(lock_file&& other) noexcept;
  lock_file& operator=(lock_file&& other) noexcept;
  ~lock_file();

  // The database file, which is there now and is not open in this process yet.
  [[nodiscard]] store_result<void> hold(const store_kind& kind, const std::string& path);
  // Of the database file; -1: it is not held. For looking at it.
  [[nodiscard]] int database_descriptor() const { return database_; }

  void release();

private:
  explicit lock_file(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
  int database_ = -1;
};

struct store_format {
  store_kind kind;
  std::int32_t application_id = 0;
  std::vector<std::string> migrations; // the first one makes the tables
  std::string read_version;            // a query
  std::string set_version;             // a statement; the number follows
  std::string settings;                // of a writing connection, beside those of all
};

enum class integrity_check {
  none,
  // Structure of every page and every row, but not that each index agrees with its table. Reads the whole file (about 1
  // GB/s from the page cache); `full` costs several times that.
  quick,
  full,
};

struct store_options {
  std::string path;
  std::string vfs;    // empty = SQLite's default
  bool create = true; // false: a file that is not there is an error
  integrity_check check = integrity_check::none;
  std::function<store_result<void>(database&)>
      inspect; // the caller's own check before anything is changed; may be empty
};

// The lock is given back after the file is closed.
struct store_file {
  lock_file lock;
  database db;
};

// Makes the folder where it is missing and takes the lock. The connection is in WAL mode, synchronous FULL, migrated,
// and leaves checkpoints to the caller.
[[nodiscard]] store_result<store_file> open_for_writing(const store_format& format, const store_options& options);

// Any number, beside a writer or without one. The caller needs no lock.
[[nodiscard]] store_result<database> open_for_reading(const store_format& format, const std::string& path,
                                                      const std::string& vfs);

[[nodiscard]] store_result<void> check_integrity(database& db, const store_kind& kind, const std::string& file,
                                                 integrity_check check);

} // namespace godwit::io::sqlite
