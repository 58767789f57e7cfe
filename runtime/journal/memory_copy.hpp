// What the journal holds of each actor, once more in memory: when the file is deleted, replaced or cut in flight, this
// is what goes on, and what a new file is made of.
//
// Snapshots keep it small: for each actor one, the events after it (100 at most), the effects that are not released
// and the marks. Not in it: dead letters, the outbox as a table for people, and typed tables. Thread: the journal's
// writer.
#pragma once

#include <string>
#include <unordered_map>

#include "io/sqlite/store_error.hpp"
#include "runtime/journal/record_store.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

class memory_copy {
public:
  // As the database has it.
  void take(const std::string& actor, const recovered& state) { actors_[actor] = state; }
  // On the disk now.
  void note(const journal_write& write);
  // All of it counts as durable: there is no disk to be behind.
  [[nodiscard]] recovered of(const std::string& actor) const;
  // Into an empty journal, within the caller's transaction.
  [[nodiscard]] io::sqlite::result<void> write_to(record_store& store) const;

private:
  std::unordered_map<std::string, recovered> actors_;
};

// What a write will do to the recovered state of its actor, in memory: the database's answer plus this, for each write
// that still waits, is what the database will answer once they are committed.
//
// Pure. Thread: any.
void lay_over(recovered& base, const journal_write& write);

} // namespace godwit::runtime
