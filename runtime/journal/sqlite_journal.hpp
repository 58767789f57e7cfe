// The journal in one SQLite file: write-ahead log, synchronous FULL, one writer thread (io/sqlite/group_writer.hpp).
//
// Files: PATH, PATH-wal and PATH-shm (SQLite's), PATH.lock (who writes), PATH.rescued (what was saved in flight). Mode
// 0600. Once a second it is looked whether they are still the same; else `failing` until somebody says rescue().
// Thread: every function from any thread, close and the destructor not from the journal's own callbacks.
// Source: https://www.sqlite.org/wal.html
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "runtime/journal/journal.hpp"
#include "runtime/journal/journal_file.hpp"

namespace godwit::runtime {

struct journal_options {
  std::string path = {};
  std::vector<table_definition> tables = {};
  bool create = true; // false: a journal that is not there is an error
  integrity_check check = integrity_check::quick;
  std::string vfs = {}; // empty = SQLite's default; tests inject faults with it

  // While the disk refuses to write everything waits here: at 100 events/s these are 16 minutes.
  std::size_t max_queued_writes = 100'000;
  std::size_t max_queued_bytes = 256 * 1024 * 1024;

  // One transaction: bounds the pages that SQLite keeps in memory and the wait of the next group.
  std::size_t max_group_writes = 2'000;
  std::size_t max_group_bytes = 8 * 1024 * 1024;

  // The log is moved into the database file when it is longer; SQLite's own default, 1000 pages.
  std::size_t checkpoint_bytes = 4 * 1024 * 1024;

  // After a disk error: the first wait, doubled each time up to the last.
  std::chrono::milliseconds retry_min{10};
  std::chrono::milliseconds retry_max{2'000};

  // How long close tries to write what waits. A disk that hangs inside one call can not be interrupted.
  std::chrono::milliseconds close_timeout{5'000};

  // On the writer thread, when `failing` turns on or off. Must be quick and must not throw.
  std::function<void(const journal_status&)> on_health_change = {};

  // False: nothing happens but in run_once, flush and close. Tests and whole systems in virtual time.
  bool own_thread = true;
  std::function<std::chrono::steady_clock::time_point()> clock = &std::chrono::steady_clock::now; // paces the retries
};

class sqlite_journal final : public journal {
public:
  // Blocks on the disk. The error names the file and the remedy.
  [[nodiscard]] static tl::expected<std::unique_ptr<sqlite_journal>, journal_error>
  open(const journal_options& options);

  ~sqlite_journal() override;

  [[nodiscard]] tl::expected<void, journal_error> submit(journal_write&& write) override;

  // On a closed journal the callback runs with an error on the calling thread.
  void recover(std::string actor, std::uint64_t incarnation, recovered_callback callback) override;

  [[nodiscard]] journal_status status() const override;

  // The file was deleted, replaced or cut: all that is in memory goes to a new one beside it, and the journal goes on
  // there. A person says so, because only a person knows what became of the old one. Calls back once, on the writer
  // thread, with the new file; with an error when the journal is as it should be.
  using rescued_callback = std::function<void(tl::expected<std::string, journal_error>)>;
  void rescue(rescued_callback callback);

  // Waits until all that was submitted before is durable; false when the time is over or, without a thread, when the
  // disk fails.
  [[nodiscard]] bool flush(std::chrono::milliseconds timeout);

  // Without a thread of its own: does what can be done now, at most one transaction.
  void run_once();

  // Writes what waits within the close timeout, tells the rest that it failed, and gives the lock back. Once.
  void close();

private:
  struct parts;

  explicit sqlite_journal(std::unique_ptr<parts> made);

  std::unique_ptr<parts> parts_;
};

} // namespace godwit::runtime
