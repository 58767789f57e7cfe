// Walks the records inside of a chunk, after its CRC and sizes were checked.
//
// Errors: unsupported (compression), crc_mismatch, malformed, each with the offset in the file. Thread: one at a time.
// Source: MCAP specification, record Chunk.
#pragma once

#include <cstdint>
#include <optional>

#include "io/mcap/record_reader.hpp"

namespace godwit::io::mcap {

class chunk_cursor {
public:
  chunk_cursor() = default; // an empty chunk

  // `reader` gave `chunk`; both must stay as they are while the cursor is used.
  [[nodiscard]] static result<chunk_cursor> open(const record_reader& reader, const raw_record& chunk);

  // The next Schema, Channel or Message record (or one unknown to us); nullopt at the end.
  [[nodiscard]] result<std::optional<raw_record>> next();

  // Offset of a record of this chunk from the start of the chunk's records.
  [[nodiscard]] std::uint64_t offset_in_chunk(const raw_record& record) const {
    return record.offset - records_offset_;
  }
  [[nodiscard]] std::uint64_t records_bytes() const { return records_.size(); }

private:
  const record_reader* reader_ = nullptr;
  byte_view records_;
  std::uint64_t records_offset_ = 0; // in the file
  std::size_t at_ = 0;
};

} // namespace godwit::io::mcap
