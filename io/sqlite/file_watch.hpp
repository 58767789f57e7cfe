// Looks at a database from outside: are its files still there, the same, and as long as they were?
//
// SQLite goes on with a file that was deleted or replaced, and notices a cut one when it is too late: what is written
// then is lost. Looked at are PATH, PATH-wal and PATH-shm; a file that grows is well. Thread: the writer's. Blocks for
// a few stat calls. Source: https://www.sqlite.org/howtocorrupt.html, 4.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <sys/types.h>

namespace godwit::io::sqlite {

// A log that is longer is cut by SQLite itself.
inline constexpr std::int64_t longest_kept_log_bytes = 64 * 1024 * 1024;

struct file_trouble {
  bool is_whole = false; // the open files hold all that they held; only nobody finds them by their name any more
  std::string what;      // "the file was deleted"
};

class file_watch {
public:
  // DESCRIPTOR: of the database file, and open for as long as this is used.
  file_watch(std::string path, int descriptor);

  [[nodiscard]] std::optional<file_trouble> look();

private:
  struct identity {
    dev_t device = 0;
    ino_t number = 0;
    std::int64_t bytes = 0;
  };
  struct part {
    const char* suffix;
    const char* name;
    std::int64_t may_shrink_from; // bytes
    std::optional<identity> known;
  };

  [[nodiscard]] static std::optional<identity> identity_of(const std::string& path);
  [[nodiscard]] std::optional<file_trouble> look_at(part& each) const;
  [[nodiscard]] std::optional<file_trouble> look_at_database();

  const std::string path_;
  const int descriptor_;
  std::int64_t bytes_ = 0;
  std::array<part, 2> beside_;
};

} // namespace godwit::io::sqlite
