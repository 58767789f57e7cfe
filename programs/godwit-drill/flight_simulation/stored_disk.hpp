// The disk of a simulated computer as a real file: the journal's own writer with SQLite, on a disk below it that fails
// when it is told to (io/sqlite/fault_vfs.hpp).
//
//   simulated_journal ──> sqlite_journal, without its thread ──> SQLite ──> fault_vfs ──> the file
//
// What fails is mended by the end of the process: the next one finds a disk that works. One at a time, because the
// faults are those of the whole process of the drill. Times in nanoseconds of the flight. Thread: one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "io/sqlite/fault_vfs.hpp"
#include "runtime/journal/records.hpp"
#include "runtime/simulation/simulated_journal.hpp"

namespace godwit::drill {

class stored_disk {
public:
  // NOW_NS is asked as long as a process runs.
  stored_disk(std::string path, std::function<std::int64_t()> now_ns);
  stored_disk(const stored_disk&) = delete;
  stored_disk& operator=(const stored_disk&) = delete;
  ~stored_disk();

  // What a process writes to: for simulated_disk::below.
  [[nodiscard]] std::unique_ptr<runtime::file_below> open();

  // From here on, until mend() or the end of the process.
  void fail(const io::sqlite::fault_plan& how);
  void mend();
  [[nodiscard]] bool has_failed() const; // since fail()
  // After the end of a process: what was written and never synced is there or not, drawn by SEED for each write.
  void lose_power(std::uint64_t seed);

private:
  std::string path_;
  std::function<std::int64_t()> now_ns_;
};

// What the executor has on the disk of what it means to do, as a process would find it that begins now. Thread: pure.
struct intent_on_disk {
  bool brings_plan = false; // an upload is intended, and its end is not known
  bool starts = false;      // the same of a start
};

// EXECUTOR: what the journal has of it. An intent that was written at SINCE_NS or later counts also when its end is
// written already: it was given up while its message was on the way to the line.
[[nodiscard]] intent_on_disk read_intent(const runtime::recovered& executor, std::int64_t since_ns);

} // namespace godwit::drill
