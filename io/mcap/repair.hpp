// Completes a segment whose writer was killed: cuts the torn last record and appends the index and the end.
//
// The end is computed in memory first; then the file is cut, and the end is appended. A crash in between, or a full
// disk, leaves a file without its end, which the next call completes to the same bytes. A complete file is left alone.
// What is cut is at most one record or one chunk that never was whole (see scan.hpp).
// Errors: io and disk_full; malformed, crc_mismatch, unsupported for a file that is damaged before its end: it stays
// as it is. Thread: one at a time for each file, and not while a writer has it open.
#pragma once

#include <cstdint>
#include <filesystem>

#include "io/mcap/byte_source.hpp"
#include "io/mcap/record_reader.hpp"

namespace godwit::io::mcap {

struct completion {
  bool was_complete = false;     // then nothing was changed, and the rest is 0
  std::uint64_t messages = 0;    // kept
  std::uint64_t cut_bytes = 0;   // of torn records, and of an end that was not whole
  std::uint64_t added_bytes = 0; // index, summary and end
};

[[nodiscard]] result<completion> complete(const std::filesystem::path& path, read_limits limits = {});

// True when the source ends with a footer whose summary CRC holds. Reads only the summary and what follows.
[[nodiscard]] result<bool> has_end(const byte_source& source);

} // namespace godwit::io::mcap
