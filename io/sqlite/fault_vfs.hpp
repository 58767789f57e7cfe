// A VFS of SQLite over the default one that fails on demand, and that can forget what was never synced.
//
// Every open, write, sync, truncate and delete is an operation and has a number, from 1 on since arm or disarm. One
// number, or all from one on, meet a fault. Reading, locking and shared memory always work. One instance for the
// process. Thread: any.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace godwit::io::sqlite {

enum class file_operation { open, write, sync, truncate, remove };

enum class fault_kind {
  io_error,
  disk_full,
  torn_write, // the first half of the bytes reaches the file, then an I/O error
};

struct fault_plan {
  fault_kind kind = fault_kind::io_error;
  std::int64_t at = 0;                     // number of the operation
  bool from_then_on = false;               // or only this one
  std::optional<file_operation> only = {}; // these alone are counted, and fail
};

class fault_vfs {
public:
  static constexpr const char* name = "godwit_fault";

  // Registers the VFS at the first call.
  static fault_vfs& instance();

  void arm(const fault_plan& plan);
  void disarm();
  // Database files open for reading only, as on a file system mounted read-only.
  void set_read_only(bool read_only);

  // Syncs succeed, and what they should have saved still counts as unsynced. Until disarm.
  void set_lying(bool lying);

  [[nodiscard]] std::int64_t operations() const; // since arm or disarm
  [[nodiscard]] bool injected() const;

  // From now on the bytes before each write are kept until the file is synced.
  void track_unsynced();
  // Ends tracking. What was never synced is lost: all of it, or with a seed each write or not by the toss of a coin,
  // because a disk writes in the order it likes. All connections must be closed.
  void cut_power(std::optional<std::uint64_t> seed);

  // For the VFS's methods: the fault that this operation meets.
  std::optional<fault_kind> next_operation(file_operation what);
  [[nodiscard]] bool read_only() const;
  [[nodiscard]] bool tracking() const;
  struct change {
    std::int64_t offset = 0;
    std::string before; // shorter than after where the file grew; longer for a truncation
    std::string after;
    std::int64_t size_before = 0;
    std::int64_t size_after = 0;
  };
  void changed(const std::string& path, change made);
  void synced(const std::string& path);

private:
  mutable std::mutex mutex_;
  std::optional<fault_plan> plan_;
  std::int64_t operations_ = 0;
  std::int64_t matching_ = 0; // the plan's, since arm
  bool injected_ = false;
  bool read_only_ = false;
  bool lying_ = false;
  bool tracking_ = false;
  std::map<std::string, std::vector<change>> unsynced_;
};

} // namespace godwit::io::sqlite
