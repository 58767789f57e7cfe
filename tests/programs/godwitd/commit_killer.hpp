// Ends the process with SIGKILL right before or right after the n-th commit of any SQLite file in it.
//
// A VFS over SQLite's own, and the default one from then on: the program under test knows nothing of it. A commit
// begins with the first write to a write-ahead log since that log was synced, and ends when the log is synced. Before:
// of the commit nothing is on the disk. After: all of it is, and nobody was told. Thread: install by one, before any
// database is open. Source: https://www.sqlite.org/vfs.html
#pragma once

#include <cstdint>

namespace godwit::test {

enum class kill_place { before, after };

// NUMBER counts from 1 on; 0: never.
void install_commit_killer(kill_place where, std::int64_t number);

} // namespace godwit::test
