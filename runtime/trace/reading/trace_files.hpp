// Which files a trace is made of: the segments of a folder in the order in which they were written, or files as given.
//
// A folder may be the trace folder or the one above it (`trace/` in it). Runs and numbers come from the names
// (godwit-RUN-NUMBER.mcap); other files are run 0 until their metadata says otherwise. Errors: a sentence. Thread:
// pure.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace godwit::runtime {

struct trace_file {
  std::filesystem::path path;
  std::uint64_t run = 0;
  std::uint64_t number = 0; // within the run, from 1; 0: not known
};

[[nodiscard]] tl::expected<std::vector<trace_file>, std::string> find_trace_files(std::span<const std::string> paths);

} // namespace godwit::runtime
