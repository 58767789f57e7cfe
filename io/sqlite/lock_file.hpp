// One writer process: an advisory lock on a file of its own beside the database, with the holder's process id inside.
//
// The kernel gives the lock back when the process ends, however it ends. The file itself stays: removing it would let
// two processes hold "the" lock on two different files. It is a file of its own because closing any descriptor of the
// database file would drop the locks that SQLite holds on it in this process. Thread: any; the object belongs to one.
// Source: flock(2).
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

  void release();

private:
  explicit lock_file(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

} // namespace godwit::io::sqlite
