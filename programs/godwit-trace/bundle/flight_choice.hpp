// Which starts of godwitd belong to one flight: a process that died in flight is started again within seconds.
//
// Thread: pure, but for reading the files.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/trace/reading/trace_files.hpp"

namespace godwit::trace_tool {

struct run_times {
  std::uint64_t run = 0;
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
};

inline constexpr std::int64_t longest_break_ns = 60'000'000'000;

// Of FILES, oldest run first. A run of which nothing can be read is left out.
[[nodiscard]] std::vector<run_times> times_of_runs(const std::vector<runtime::trace_file>& files);

// The runs that follow one another with breaks of at most `longest_break_ns`, and among which AT_NS is, or the newest
// ones. Empty: there is none then.
[[nodiscard]] std::vector<std::uint64_t> runs_of_flight(const std::vector<run_times>& runs,
                                                        std::optional<std::int64_t> at_ns);

} // namespace godwit::trace_tool
