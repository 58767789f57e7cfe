// Chunks of an MCAP file: compressed, filled by a writer, walked by a reader.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "io/mcap/format.hpp"
#include "io/mcap/record_reader.hpp"
#include "io/mcap/records.hpp"
#include "io/mcap/summary.hpp"

namespace godwit::io::mcap {

// Chunks compressed with Zstandard, the one compression of MCAP that is written and read here.
//
// Both keep their memory from call to call. Errors: as false; what was put out is then not to be used. Thread: one at a
// time. Source: MCAP specification, "Well-known compression formats"; RFC 8878.
inline constexpr std::string_view zstd_name = "zstd";

class compressor {
public:
  compressor();
  ~compressor();
  compressor(compressor&&) noexcept;
  compressor& operator=(compressor&&) noexcept;

  // Appends RECORDS, compressed, to OUT. False: they do not become smaller.
  [[nodiscard]] bool compress(byte_view records, byte_buffer& out);

private:
  struct context;
  std::unique_ptr<context> context_; // made with the first chunk
};

class decompressor {
public:
  decompressor();
  ~decompressor();
  decompressor(decompressor&&) noexcept;
  decompressor& operator=(decompressor&&) noexcept;

  // OUT becomes the records, which are to be RECORDS_BYTES. The caller has bounded that number.
  [[nodiscard]] bool decompress(byte_view compressed, std::uint64_t records_bytes, byte_buffer& out);

private:
  struct context;
  std::unique_ptr<context> context_;
};

// The chunk that is being filled, and the form that it has in the file: Chunk record, then its Message Index records.
// Cleared, it keeps its memory for the next chunk.
//
// Compressed as a whole when it is finished, so that a killed process leaves whole chunks, each of which is read by
// itself. Thread: one at a time. Source: MCAP specification, records Chunk and Message.
class chunk_builder {
public:
  // Fewer bytes of records stay as they are: they would hardly become smaller.
  static constexpr std::size_t compressed_from_bytes = 512;

  // `record` is a whole Schema or Channel record.
  void add_definition(byte_view record) { append_bytes(records_, record); }
  void add_message(const message_record& message);

  [[nodiscard]] bool empty() const { return records_.empty(); }
  [[nodiscard]] std::uint64_t message_count() const { return index_.message_count(); }
  [[nodiscard]] const message_index& index() const { return index_; }
  // What finish() gives, were it called now, is not longer.
  [[nodiscard]] std::uint64_t encoded_bytes() const {
    return chunk_header_bytes + records_.size() + index_.encoded_bytes();
  }

  // Completes the chunk that will stand at `file_offset`; the bytes are in encoded() until clear().
  [[nodiscard]] chunk_index_entry finish(std::uint64_t file_offset);
  [[nodiscard]] byte_view encoded() const { return encoded_; }
  void clear();

private:
  void append_records(chunk_index_entry& entry);

  byte_buffer records_;
  byte_buffer encoded_;
  message_index index_;
  compressor compressor_;
};

// Walks the records inside of a chunk, after its CRC and sizes were checked.
//
// Errors: unsupported (compression), crc_mismatch, malformed, each with the offset in the file. Thread: one at a time.
// Source: MCAP specification, record Chunk.
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
