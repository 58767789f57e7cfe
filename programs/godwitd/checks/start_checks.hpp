// What is checked before the daemon starts, and by --check-config: the files of its state, its clock, its limits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/journal/journal_file.hpp"

namespace godwit::daemon {

// Whether what is on disk is godwit's, and of a version that this godwit reads. Only reads, also beside a running one.
//
// Errors: sentences with the file and the remedy. Thread: any; blocks on the disk.

// Of the parts of godwitd, beside the journal's own.
[[nodiscard]] std::vector<runtime::table_definition> journal_tables();

// Why FILE can not be taken over: foreign, newer or damaged. Nothing: it can, or is not there yet.
[[nodiscard]] std::optional<std::string> objection_to_journal(const std::string& file);
[[nodiscard]] std::optional<std::string> objection_to_map(const std::string& file);

// Whether the clocks of this computer can be counted in nanoseconds: 64 bits of them end in the year 2262.
//
// Thread: pure, but for clock_now.
struct clock_reading {
  std::int64_t wall_s = 0;      // since 1970 UTC
  std::int64_t monotonic_s = 0; // of CLOCK_MONOTONIC
};

[[nodiscard]] clock_reading clock_now();

// Why godwitd can not run on it, as a sentence for people. Room for a century is kept.
[[nodiscard]] std::optional<std::string> objection_to_clock(const clock_reading& now);

// Whether the limits of this process leave room for godwitd: below them a start ends somewhere in the middle of a
// library, without a sentence. Thread: pure, but for limits_now. Source: getrlimit(2).

// Measured: 1 GB runs, 600 MB does not always; each thread takes address space that it never uses.
inline constexpr std::uint64_t least_address_space = 900'000'000;
// Measured: 26 in flight, 8 for clients of the control socket, and some for links that come and go.
inline constexpr std::uint64_t least_descriptors = 64;

struct process_limits {
  std::uint64_t address_space = 0; // bytes; RLIMIT_AS
  std::uint64_t descriptors = 0;   // RLIMIT_NOFILE
};

[[nodiscard]] process_limits limits_now();

// Why godwitd can not run with them, as a sentence for people.
[[nodiscard]] std::optional<std::string> objection_to_limits(const process_limits& now);

} // namespace godwit::daemon
