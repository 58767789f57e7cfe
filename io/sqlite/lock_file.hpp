// One writer process: an advisory lock on a file of its own beside the database, with the holder's process id inside.
//
// A name is not the file: under a link, or without the lock file, another process would lock something else. So the
// database file itself is locked as well, by its inode, once it is there; a file with several names (hard links) is
// refused, because SQLite keeps a log for each name. The kernel gives the lock back when the process ends, however it
// ends. The file itself stays: removing it would let two processes hold "the" lock on two different files. It is a file
// of its own because closing any descriptor of the database file would drop the locks that SQLite holds on it in this
// process; for the same reason the descriptor of the database file that is held here is closed last. Thread: any; the
// object belongs to one. Source: flock(2).
#pragma once

#include <string>

#include "io/sqlite/store_error.hpp"

namespace godwit::io::sqlite {

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

} // namespace godwit::io::sqlite
