// What can go wrong with a journal, as a value for the caller and a sentence for people.
//
// Every error names the file and the remedy. Thread: plain value, any thread.
#pragma once

#include <string>

namespace godwit::runtime {

enum class journal_errc {
  locked,            // another process writes this journal
  missing,           // asked to open an existing journal, there is none
  foreign,           // the file is something else than a godwit journal
  newer,             // written by a later version of godwit or of one of its tables
  corrupt,           // the integrity check failed
  read_only,         // the file or its folder can not be written
  disk_full,         // no space left
  io,                // the disk reported an error
  queue_full,        // the writer is late by its bound; nothing was taken
  stale_incarnation, // a crashed incarnation tried to write after its successor had started
  closed,            // the journal is shutting down
};

struct journal_error {
  journal_errc code{};
  std::string file;   // the path concerned
  std::string what;   // what is wrong, with the detail that SQLite or the system gave
  std::string remedy; // what a person can do about it

  // "journal /var/lib/godwit/journal.db: disk is full (...). Free some space; godwit goes on by itself."
  [[nodiscard]] std::string message() const;
};

} // namespace godwit::runtime
