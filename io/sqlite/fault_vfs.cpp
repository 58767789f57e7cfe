#include "io/sqlite/fault_vfs.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include <sqlite3.h>

namespace godwit::io::sqlite {

namespace {

// SQLite gives memory for this and, after it, for the real file.
struct fault_file {
  sqlite3_file base;
  const char* path; // SQLite keeps it until the file is closed; null for a temporary file
};

constexpr std::size_t real_offset = (sizeof(fault_file) + 15) / 16 * 16;

sqlite3_vfs* real_vfs() {
  static sqlite3_vfs* found = sqlite3_vfs_find(nullptr);
  return found;
}

sqlite3_file* real_of(sqlite3_file* file) {
  return reinterpret_cast<sqlite3_file*>(reinterpret_cast<char*>(file) + real_offset);
}

std::string path_of(sqlite3_file* file) {
  const char* path = reinterpret_cast<fault_file*>(file)->path;
  return path != nullptr ? path : "";
}

int code_of(fault_kind kind, int io_code) { return kind == fault_kind::disk_full ? SQLITE_FULL : io_code; }

std::string content(sqlite3_file* file, std::int64_t offset, std::int64_t count) {
  std::string bytes(static_cast<std::size_t>(std::max<std::int64_t>(count, 0)), '\0');
  if (!bytes.empty())
    real_of(file)->pMethods->xRead(real_of(file), bytes.data(), static_cast<int>(bytes.size()), offset);
  return bytes;
}

void note_write(sqlite3_file* file, const void* data, int count, std::int64_t offset) {
  auto& vfs = fault_vfs::instance();
  if (!vfs.tracking())
    return;
  sqlite3_int64 size = 0;
  real_of(file)->pMethods->xFileSize(real_of(file), &size);
  const auto overlap = std::min<std::int64_t>(count, size - offset);
  vfs.changed(path_of(file), {offset, content(file, offset, overlap),
                              std::string(static_cast<const char*>(data), static_cast<std::size_t>(count)), size,
                              std::max<std::int64_t>(size, offset + count)});
}

int file_write(sqlite3_file* file, const void* data, int count, sqlite3_int64 offset) {
  auto* real = real_of(file);
  const auto fault = fault_vfs::instance().next_operation(file_operation::write);
  if (fault == fault_kind::torn_write && count > 1) {
    note_write(file, data, count / 2, offset);
    real->pMethods->xWrite(real, data, count / 2, offset);
  }
  if (fault)
    return code_of(*fault, SQLITE_IOERR_WRITE);
  note_write(file, data, count, offset);
  return real->pMethods->xWrite(real, data, count, offset);
}

int file_truncate(sqlite3_file* file, sqlite3_int64 size) {
  auto* real = real_of(file);
  if (const auto fault = fault_vfs::instance().next_operation(file_operation::truncate))
    return code_of(*fault, SQLITE_IOERR_TRUNCATE);
  if (fault_vfs::instance().tracking()) {
    sqlite3_int64 before = 0;
    real->pMethods->xFileSize(real, &before);
    fault_vfs::instance().changed(path_of(file), {size, content(file, size, before - size), "", before, size});
  }
  return real->pMethods->xTruncate(real, size);
}

int file_sync(sqlite3_file* file, int flags) {
  if (const auto fault = fault_vfs::instance().next_operation(file_operation::sync))
    return code_of(*fault, SQLITE_IOERR_FSYNC);
  const int code = real_of(file)->pMethods->xSync(real_of(file), flags);
  if (code == SQLITE_OK)
    fault_vfs::instance().synced(path_of(file));
  return code;
}

const sqlite3_io_methods methods = {
    .iVersion = 2, // without memory mapping, so that every byte comes through here
    .xClose = [](sqlite3_file* f) { return real_of(f)->pMethods->xClose(real_of(f)); },
    .xRead = [](sqlite3_file* f, void* data, int count,
                sqlite3_int64 offset) { return real_of(f)->pMethods->xRead(real_of(f), data, count, offset); },
    .xWrite = file_write,
    .xTruncate = file_truncate,
    .xSync = file_sync,
    .xFileSize = [](sqlite3_file* f, sqlite3_int64* size) { return real_of(f)->pMethods->xFileSize(real_of(f), size); },
    .xLock = [](sqlite3_file* f, int level) { return real_of(f)->pMethods->xLock(real_of(f), level); },
    .xUnlock = [](sqlite3_file* f, int level) { return real_of(f)->pMethods->xUnlock(real_of(f), level); },
    .xCheckReservedLock = [](sqlite3_file* f,
                             int* out) { return real_of(f)->pMethods->xCheckReservedLock(real_of(f), out); },
    .xFileControl = [](sqlite3_file* f, int operation,
                       void* argument) { return real_of(f)->pMethods->xFileControl(real_of(f), operation, argument); },
    .xSectorSize = [](sqlite3_file* f) { return real_of(f)->pMethods->xSectorSize(real_of(f)); },
    .xDeviceCharacteristics = [](sqlite3_file* f) { return real_of(f)->pMethods->xDeviceCharacteristics(real_of(f)); },
    .xShmMap = [](sqlite3_file* f, int page, int size, int extend,
                  void volatile** out) { return real_of(f)->pMethods->xShmMap(real_of(f), page, size, extend, out); },
    .xShmLock = [](sqlite3_file* f, int offset, int n,
                   int flags) { return real_of(f)->pMethods->xShmLock(real_of(f), offset, n, flags); },
    .xShmBarrier = [](sqlite3_file* f) { real_of(f)->pMethods->xShmBarrier(real_of(f)); },
    .xShmUnmap = [](sqlite3_file* f, int remove) { return real_of(f)->pMethods->xShmUnmap(real_of(f), remove); },
    .xFetch = nullptr,
    .xUnfetch = nullptr,
};

int vfs_open(sqlite3_vfs*, const char* path, sqlite3_file* file, int flags, int* out_flags) {
  file->pMethods = nullptr;
  auto& vfs = fault_vfs::instance();
  if (const auto fault = vfs.next_operation(file_operation::open))
    return code_of(*fault, SQLITE_CANTOPEN);
  if (vfs.read_only() && (flags & SQLITE_OPEN_READWRITE) != 0) {
    flags &= ~(SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    flags |= SQLITE_OPEN_READONLY;
  }
  reinterpret_cast<fault_file*>(file)->path = path;
  const int code = real_vfs()->xOpen(real_vfs(), path, real_of(file), flags, out_flags);
  if (real_of(file)->pMethods != nullptr)
    file->pMethods = &methods;
  return code;
}

int vfs_delete(sqlite3_vfs*, const char* path, int sync_folder) {
  if (const auto fault = fault_vfs::instance().next_operation(file_operation::remove))
    return code_of(*fault, SQLITE_IOERR_DELETE);
  fault_vfs::instance().synced(path);
  return real_vfs()->xDelete(real_vfs(), path, sync_folder);
}

sqlite3_vfs make_vfs() {
  sqlite3_vfs made = *real_vfs(); // the rest of the methods does not depend on which VFS calls it
  made.szOsFile = static_cast<int>(real_offset) + real_vfs()->szOsFile;
  made.pNext = nullptr;
  made.zName = fault_vfs::name;
  made.xOpen = vfs_open;
  made.xDelete = vfs_delete;
  return made;
}

// Makes [offset, offset + bytes) hold BYTES and the file SIZE long.
void put(const std::string& path, std::int64_t offset, const std::string& bytes, std::int64_t size) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    return;
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(offset);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(size), ignored);
}

} // namespace

fault_vfs& fault_vfs::instance() {
  static fault_vfs* made = [] {
    static sqlite3_vfs vfs = make_vfs();
    if (sqlite3_vfs_register(&vfs, 0) != SQLITE_OK)
      std::abort();
    return new fault_vfs; // never destroyed: connections may outlive the static objects
  }();
  return *made;
}

void fault_vfs::arm(const fault_plan& plan) {
  std::lock_guard lock(mutex_);
  plan_ = plan;
  operations_ = 0;
  matching_ = 0;
  injected_ = false;
}

void fault_vfs::disarm() {
  std::lock_guard lock(mutex_);
  plan_.reset();
  operations_ = 0;
  matching_ = 0;
  injected_ = false;
  read_only_ = false;
  lying_ = false;
}

void fault_vfs::set_read_only(bool read_only) {
  std::lock_guard lock(mutex_);
  read_only_ = read_only;
}

void fault_vfs::set_lying(bool lying) {
  std::lock_guard lock(mutex_);
  lying_ = lying;
}

std::int64_t fault_vfs::operations() const {
  std::lock_guard lock(mutex_);
  return operations_;
}

bool fault_vfs::injected() const {
  std::lock_guard lock(mutex_);
  return injected_;
}

bool fault_vfs::read_only() const {
  std::lock_guard lock(mutex_);
  return read_only_;
}

bool fault_vfs::tracking() const {
  std::lock_guard lock(mutex_);
  return tracking_;
}

std::optional<fault_kind> fault_vfs::next_operation(file_operation what) {
  std::lock_guard lock(mutex_);
  ++operations_;
  if (!plan_ || (plan_->only && *plan_->only != what))
    return std::nullopt;
  ++matching_;
  if (matching_ < plan_->at || (matching_ > plan_->at && !plan_->from_then_on))
    return std::nullopt;
  injected_ = true;
  return plan_->kind;
}

void fault_vfs::track_unsynced() {
  std::lock_guard lock(mutex_);
  tracking_ = true;
  unsynced_.clear();
}

void fault_vfs::changed(const std::string& path, change made) {
  std::lock_guard lock(mutex_);
  unsynced_[path].push_back(std::move(made));
}

void fault_vfs::synced(const std::string& path) {
  std::lock_guard lock(mutex_);
  if (!lying_)
    unsynced_.erase(path);
}

void fault_vfs::cut_power(std::optional<std::uint64_t> seed) {
  std::lock_guard lock(mutex_);
  tracking_ = false;
  std::mt19937_64 random(seed.value_or(0));
  for (auto& [path, changes] : unsynced_) {
    for (auto undo = changes.rbegin(); undo != changes.rend(); ++undo) // NOLINT(modernize-loop-convert): backwards
      put(path, undo->offset, undo->before, undo->size_before);
    if (!seed)
      continue;
    std::int64_t size = changes.front().size_before;
    for (const auto& redo : changes) {
      if (random() % 2 == 0)
        continue;
      size = redo.after.empty()
                 ? redo.size_after
                 : std::max<std::int64_t>(size, redo.offset + static_cast<std::int64_t>(redo.after.size()));
      put(path, redo.offset, redo.after, size);
    }
  }
  unsynced_.clear();
}

} // namespace godwit::io::sqlite
