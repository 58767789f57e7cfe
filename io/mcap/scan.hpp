// Reads a file whose end is missing and tells what of it is whole and what its end would be.
//
// Pure over a byte source: nothing is changed here. A torn last record is left out, a torn last chunk as a whole (its
// CRC can not be checked), and so is a last record that fails its checks and reaches the end of the file. Damage with
// more data after it is an error: cutting there would lose what can still be read.
// Errors: those of stream_reader, and unsupported for attachments. Thread: one at a time.
// Source: MCAP specification, sections "Data Section" and "Summary Section".
#pragma once

#include <cstdint>

#include "io/mcap/byte_source.hpp"
#include "io/mcap/record_reader.hpp"

namespace godwit::io::mcap {

struct completion_plan {
  std::uint64_t keep_bytes = 0; // of the file as it is
  byte_buffer tail;             // to be appended to them; together they are a complete file
  std::uint64_t messages = 0;   // in the file
};

[[nodiscard]] result<completion_plan> plan_completion(const byte_source& source, read_limits limits = {});

} // namespace godwit::io::mcap
