// Walks the records inside of a chunk, after its CRC and sizes were checked.
//
// Errors: unsupported (compression), crc_mismatch, malformed, each with the offset in the file. Thread: one at a time.
// Source: MCAP specification, record Chunk.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/mcap/compression.hpp"
#include "io/mcap/record_reader.hpp"

namespace godwit::io::mcap {

class chunk_cursor {
public:
  chunk_cursor() = default; // an empty chunk

  // `reader` gave `chunk`; both, and MEMORY, in which a compressed chunk is laid out, must stay as they are while the
  // cursor is used.
  struct memory {
    decompressor unpack;
    byte_buffer records;
  };
  [[nodiscard]] static result<chunk_cursor> open(const record_reader& reader, const raw_record& chunk, memory& memory);

  // The next Schema, Channel or Message record (or one unknown to us); nullopt at the end.
  [[nodiscard]] result<std::optional<raw_record>> next();

  [[nodiscard]] std::string_view compression() const { return compression_; }
  [[nodiscard]] std::uint64_t compressed_bytes() const { return compressed_bytes_; }
  // Offset of a record of this chunk from the start of the chunk's records.
  [[nodiscard]] std::uint64_t offset_in_chunk(const raw_record& record) const {
    return record.offset - records_offset_;
  }
  [[nodiscard]] std::uint64_t records_bytes() const { return records_.size(); }

private:
  const record_reader* reader_ = nullptr;
  byte_view records_;
  std::string_view compression_;
  std::uint64_t compressed_bytes_ = 0;
  std::uint64_t records_offset_ = 0; // in the file; of compressed ones each is said to stand as if they were not
  std::size_t at_ = 0;
};

} // namespace godwit::io::mcap
