// Keeps the write-ahead log of the map short: moves it into the database file when it is long and nobody waits, or when
// it has become very long all the same.
//
// A move writes its pages one by one and syncs the file: some 5 to 30 ms for the first bound. An error hurts nobody,
// the rows are safe in the log. Thread: the one of the database.
#pragma once

#include <cstdint>

#include "io/sqlite/database.hpp"

struct sqlite3;

namespace godwit::mapobjects_store {

class log_keeper {
public:
  // Long: a load writes the same inner pages again and again, and they are moved once. Very long: a minute of sightings
  // at full rate.
  static constexpr std::int64_t long_bytes = 16 * 1024 * 1024;
  static constexpr std::int64_t very_long_bytes = 64 * 1024 * 1024;

  explicit log_keeper(io::sqlite::database& db);
  ~log_keeper();
  log_keeper(const log_keeper&) = delete;
  log_keeper& operator=(const log_keeper&) = delete;

  // After a commit, with nothing under way. BUSY: others wait.
  void look_after(bool busy);

  // Everything into the database file, as far as readers allow.
  void close();

private:
  static int count_frames(void* self, sqlite3* connection, const char* schema, int frames);

  io::sqlite::database& db_;
  std::int64_t page_bytes_;
  std::int64_t frames_ = 0;       // of the log after the last commit
  std::int64_t moved_frames_ = 0; // at the last move that was not whole: a reader holds the rest
};

} // namespace godwit::mapobjects_store
