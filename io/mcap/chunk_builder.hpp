// The chunk that is being filled, and the form that it has in the file: Chunk record, then its Message Index records.
// Cleared, it keeps its memory for the next chunk.
//
// Compressed as a whole when it is finished, so that a killed process leaves whole chunks, each of which is read by
// itself. Thread: one at a time. Source: MCAP specification, records Chunk and Message.
#pragma once

#include <cstdint>

#include "io/mcap/compression.hpp"
#include "io/mcap/message_index.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

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

} // namespace godwit::io::mcap
