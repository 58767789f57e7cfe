// Completes a segment whose writer was killed: cuts the torn last record and appends the index and the end.
//
// The end is computed in memory first; then the file is cut, and the end is appended. A crash in between, or a full
// disk, leaves a file without its end, which the next call completes to the same bytes. A complete file is left alone.
// What is cut is at most one record or one chunk that never was whole (see completion_plan).
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

// Reads a file whose end is missing and tells what of it is whole and what its end would be.
//
// Pure over a byte source: nothing is changed here. A torn last record is left out, a torn last chunk as a whole (its
// CRC can not be checked), and so is a last record that fails its checks and reaches the end of the file. Damage with
// more data after it is an error: cutting there would lose what can still be read.
// Errors: io, malformed, crc_mismatch, too_large; unsupported for other compressions and for attachments. Thread: one
// at a time. Source: MCAP specification, sections "Data Section" and "Summary Section".
struct completion_plan {
  std::uint64_t keep_bytes = 0; // of the file as it is
  byte_buffer tail;             // to be appended to them; together they are a complete file
  std::uint64_t messages = 0;   // in the file
};

[[nodiscard]] result<completion_plan> plan_completion(const byte_source& source, read_limits limits = {});

} // namespace godwit::io::mcap
