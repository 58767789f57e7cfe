// Where the .tlog files of the links lie, and what they may take. Sizes in bytes. Thread: values.
#pragma once

#include <cstdint>
#include <filesystem>

#include "runtime/clock.hpp"
#include "runtime/trace/ring_trace.hpp"

namespace godwit::daemon {

struct link_log_options {
  std::filesystem::path folder; // that of the trace
  std::uint64_t segment_bytes = std::uint64_t{8} << 20U;
  std::uint64_t total_bytes = std::uint64_t{32} << 20U; // of one link; the oldest files are deleted
  runtime::milliseconds flush{100};                     // what a SIGKILL may cost
};

// Takes a quarter of what TRACE may fill, an eighth for each of the two links, so that the bound of the folder stays
// what was set. Files get smaller where two of them would not fit.
[[nodiscard]] link_log_options share_of(runtime::trace_options& trace);

} // namespace godwit::daemon
