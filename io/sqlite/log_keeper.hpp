// Keeps a write-ahead log short: moves it into the database file when it is long and nobody waits, or when it has
// become very long all the same.
//
// A move writes its pages one by one and syncs the file: some 5 to 30 ms for 16 MiB. An error hurts nobody, the rows
// are safe in the log; it is tried again when the log has grown by as much again. Room for the log is written
// beforehand. Thread: the one of the database.
#pragma once

#include <cstdint>

#include "io/sqlite/database.hpp"

namespace godwit::io::sqlite {

struct log_bounds {
  std::int64_t long_bytes = 0;      // moved when nobody waits
  std::int64_t very_long_bytes = 0; // moved although others wait
};

class log_keeper {
public:
  log_keeper(database& db, log_bounds bounds);
  ~log_keeper();
  log_keeper(const log_keeper&) = delete;
  log_keeper& operator=(const log_keeper&) = delete;

  // After a commit, with nothing under way. BUSY: others wait.
  void look_after(bool busy);

  // Everything into the database file, as far as readers allow; what is left is read at the next start.
  void close();

private:
  static int count_frames(void* self, sqlite3* connection, const char* schema, int frames);

  database& db_;
  const log_bounds bounds_;
  std::int64_t page_bytes_;
  std::int64_t frames_ = 0;       // of the log after the last commit
  std::int64_t moved_frames_ = 0; // at the last move that was not whole: a reader holds the rest
};

// Room for the write-ahead log, written before it is needed.
//
// A commit that makes the log longer has to change the file system's own records too: on ext4 an fdatasync then takes
// milliseconds instead of a tenth of one. SQLite writes the log again from its beginning after each checkpoint, so room
// that was filled once stays cheap. The filling is zeros, which no frame's checksum matches: recovery ends before them.
// Thread: the one of the database. Source: https://www.sqlite.org/walformat.html

// The database is in WAL mode and nobody else writes. What the log holds already stays as it is.
[[nodiscard]] result<void> reserve_log(database& db, std::int64_t bytes);

} // namespace godwit::io::sqlite
