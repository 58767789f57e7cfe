// One connection to one SQLite file.
//
// Errors are values. A failed open leaves nothing behind. Thread: one thread at a time (SQLite's multi-thread mode).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "io/sqlite/statement.hpp"
#include "io/sqlite/store_error.hpp"

struct sqlite3;

namespace godwit::io::sqlite {

enum class open_mode {
  read_only,
  immutable, // read only, and nobody else writes: takes no locks and needs neither -wal nor -shm
  read_write,
  create, // read and write, made where it is missing
};

struct open_options {
  open_mode mode = open_mode::read_write;
  std::string vfs = {};      // name of a registered VFS; empty = the default one
  int busy_timeout_ms = 250; // how long to wait for locks of other connections
};

class database {
public:
  [[nodiscard]] static result<database> open(const std::string& path, const open_options& options);

  // Its statements must be gone before. Nothing else may be called afterwards.
  void close() { handle_.reset(); }

  // Runs one or several statements and drops their rows.
  [[nodiscard]] result<void> exec(const std::string& sql);

  // Prepares one statement; text after it is an error.
  [[nodiscard]] result<statement> prepare(const std::string& sql);

  // First column of the first row; 0 or empty where there is no row.
  [[nodiscard]] result<std::int64_t> query_integer(const std::string& sql);
  [[nodiscard]] result<std::string> query_text(const std::string& sql);

  [[nodiscard]] bool in_transaction() const;
  // At close the log is neither moved into the file nor deleted: the files at these names may be somebody else's.
  void leave_log_at_close();
  [[nodiscard]] bool read_only() const;       // also true where SQLite fell back to reading
  [[nodiscard]] std::int64_t changes() const; // rows changed by the last statement
  [[nodiscard]] sqlite3* handle() const { return handle_.get(); }

private:
  struct closer {
    void operator()(sqlite3* handle) const;
  };
  using handle_ptr = std::unique_ptr<sqlite3, closer>;

  explicit database(handle_ptr handle) : handle_(std::move(handle)) {}

  handle_ptr handle_;
};

// TEXT as a literal, for a statement that can not have parameters.
[[nodiscard]] std::string quoted(const std::string& text);

// A write transaction that rolls back unless it was committed.
//
// Thread: the one of its database.
class transaction {
public:
  // IMMEDIATE takes the write lock at once: a transaction that began can not meet SQLITE_BUSY half way.
  [[nodiscard]] static result<transaction> begin(database& db);

  transaction(transaction&& other) noexcept;
  transaction& operator=(transaction&&) = delete;
  ~transaction();

  // After an error nothing of the transaction is visible.
  [[nodiscard]] result<void> commit();
  void rollback();

private:
  explicit transaction(database& db) : db_(&db) {}

  database* db_; // null when it has ended
};

// A consistent copy of a database, also while another process writes it.
//
// The copy is one moment of the original, and is whole in one file: nothing of it lies in a -wal. Writers of the
// original are not held up. Errors: those of SQLite; the copy is then not to be used. Blocks on the disk. Thread: one
// at a time. Source: https://www.sqlite.org/backup.html

// The file TO becomes the copy, whatever was in it.
[[nodiscard]] result<void> back_up(database& from, const std::string& to);

} // namespace godwit::io::sqlite
