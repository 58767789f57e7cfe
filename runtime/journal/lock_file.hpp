// One writer process: an advisory lock on a file of its own beside the journal, with the holder's process id inside.
//
// The kernel gives the lock back when the process ends, however it ends. The file itself stays: removing it would let
// two processes hold "the" lock on two different files. It is a file of its own because closing any descriptor of the
// database file would drop the locks that SQLite holds on it in this process. Thread: any; the object belongs to one.
// Source: flock(2).
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "runtime/journal/error.hpp"

namespace godwit::runtime {

class lock_file {
public:
  // JOURNAL is named in errors; the lock is JOURNAL.lock.
  [[nodiscard]] static tl::expected<lock_file, journal_error> acquire(const std::string& journal);

  lock_file(lock_file&& other) noexcept;
  lock_file& operator=(lock_file&& other) noexcept;
  ~lock_file();

  void release();

private:
  explicit lock_file(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

} // namespace godwit::runtime
