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

  // TIME outlives it.
  host_facts(disk_reader read_free_bytes, const runtime::time_source& time)
      : read_free_bytes_(std::move(read_free_bytes)), time_(time) {}

  [[nodiscard]] std::optional<std::uint64_t> free_bytes();
  [[nodiscard]] const runtime::time_source& time() const { return time_; }

private:
  const disk_reader read_free_bytes_;
  const runtime::time_source& time_;
  std::mutex mutex_; // over the next two
  std::optional<std::int64_t> read_ns_;
  std::optional<std::uint64_t> free_bytes_;
};

// On the file system of FILE, for a process without privileges.
[[nodiscard]] std::optional<std::uint64_t> free_bytes_beside(const std::string& file);

// What the operating system says about this process. Where it does not tell, a figure is 0.
//
// Reads /proc and asks no disk. Thread: any. Source: proc(5), getrusage(2), getrlimit(2).

// Without the free bytes of the disk. BEGAN_MS: since 1970 (UTC).
[[nodiscard]] health::process_figures look_at_process(std::int64_t began_ms);

} // namespace godwit::daemon
