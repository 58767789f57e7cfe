#include "tests/programs/godwitd/commit_killer.hpp"

#include <csignal>
#include <cstdlib>
#include <mutex>
#include <set>

#include <sqlite3.h>
#include <unistd.h>

namespace godwit::test {
namespace {

// One for the process, as the VFS is.
struct killer {
  kill_place where = kill_place::before;
  std::int64_t number = 0;
  std::mutex mutex;
  std::int64_t begun = 0;
  std::int64_t ended = 0;
  std::set<sqlite3_file*> open_commits;
  const sqlite3_io_methods* real = nullptr; // those of a write-ahead log: always the same
  sqlite3_io_methods watched{};
  sqlite3_vfs vfs{};
};

killer& the_killer() {
  static auto* const made = new killer; // never destroyed: connections may outlive the static objects
  return *made;
}

void count(std::int64_t killer::*counter, kill_place here) {
  auto& k = the_killer();
  if (++(k.*counter) == k.number && k.where == here)
    ::kill(::getpid(), SIGKILL);
}

int watched_write(sqlite3_file* file, const void* bytes, int size, sqlite3_int64 offset) {
  auto& k = the_killer();
  {
    const std::lock_guard guard(k.mutex);
    if (k.open_commits.insert(file).second)
      count(&killer::begun, kill_place::before);
  }
  return k.real->xWrite(file, bytes, size, offset);
}

int watched_sync(sqlite3_file* file, int flags) {
  auto& k = the_killer();
  const int code = k.real->xSync(file, flags);
  const std::lock_guard guard(k.mutex);
  if (k.open_commits.erase(file) != 0)
    count(&killer::ended, kill_place::after);
  return code;
}

int watched_open(sqlite3_vfs* vfs, sqlite3_filename name, sqlite3_file* file, int flags, int* given) {
  auto* const below = static_cast<sqlite3_vfs*>(vfs->pAppData);
  const int code = below->xOpen(below, name, file, flags, given);
  if (code != SQLITE_OK || (flags & SQLITE_OPEN_WAL) == 0)
    return code;
  auto& k = the_killer();
  const std::lock_guard guard(k.mutex);
  if (k.real == nullptr) {
    k.real = file->pMethods;
    k.watched = *k.real;
    k.watched.xWrite = watched_write;
    k.watched.xSync = watched_sync;
  }
  if (file->pMethods != k.real)
    std::abort(); // SQLite has two kinds of logs now: this file has to learn it
  file->pMethods = &k.watched;
  return code;
}

} // namespace

void install_commit_killer(kill_place where, std::int64_t number) {
  auto& k = the_killer();
  k.where = where;
  k.number = number;
  auto* const below = ::sqlite3_vfs_find(nullptr);
  k.vfs = *below; // its other methods take no heed of which VFS calls them
  k.vfs.zName = "godwit_commit_killer";
  k.vfs.pNext = nullptr;
  k.vfs.pAppData = below;
  k.vfs.xOpen = watched_open;
  if (::sqlite3_vfs_register(&k.vfs, 1) != SQLITE_OK)
    std::abort();
}

} // namespace godwit::test
