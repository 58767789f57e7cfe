// What the machine has left, asked of the system once in a few seconds and not at each look: a disk fills slowly, and
// the question is a system call.
//
// Thread: any.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "actors/health/report.hpp"
#include "runtime/clock.hpp"

namespace godwit::daemon {

class host_facts {
public:
  // In bytes; nothing: the system does not say.
  using disk_reader = std::function<std::optional<std::uint64_t>()>;

  // So old a fact may be. A preflight check that sees a disk run full 5 s late is in time: it asks for hundreds of MiB.
  static constexpr std::chrono::seconds period{5};

  // Whether the file that this process was started from is no longer what lies in its place.
  using program_reader = std::function<bool()>;

  // TIME outlives it.
  host_facts(
      disk_reader read_free_bytes, const runtime::time_source& time, program_reader read_program = [] { return false; })
      : read_free_bytes_(std::move(read_free_bytes)), read_program_(std::move(read_program)), time_(time) {}

  [[nodiscard]] std::optional<std::uint64_t> free_bytes();
  [[nodiscard]] bool is_program_exchanged();
  [[nodiscard]] const runtime::time_source& time() const { return time_; }

private:
  void read_if_old(); // with the mutex held

  const disk_reader read_free_bytes_;
  const program_reader read_program_;
  const runtime::time_source& time_;
  std::mutex mutex_; // over the next three
  std::optional<std::int64_t> read_ns_;
  std::optional<std::uint64_t> free_bytes_;
  bool is_program_exchanged_ = false;
};

// On the file system of FILE, for a process without privileges.
[[nodiscard]] std::optional<std::uint64_t> free_bytes_beside(const std::string& file);

// LINK leads to the file that a process was started from: /proc/self/exe. A package manager puts the new file in the
// place of the old one, which then has no name any more.
[[nodiscard]] bool is_without_name(const std::string& link);

// What the operating system says about this process. Where it does not tell, a figure is 0.
//
// Reads /proc and asks no disk. Thread: any. Source: proc(5), getrusage(2), getrlimit(2).

// Without the free bytes of the disk. BEGAN_MS: since 1970 (UTC).
[[nodiscard]] health::process_figures look_at_process(std::int64_t began_ms);

} // namespace godwit::daemon
