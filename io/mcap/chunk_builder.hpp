// The chunk that is being filled, in one buffer in the form it will have in the file: Chunk record, then its Message
// Index records. Cleared, it keeps its memory for the next chunk.
//
// Uncompressed: a process that is killed leaves a chunk that any reader opens, and compression costs more than the
// disk. Thread: one at a time. Source: MCAP specification, records Chunk and Message.
#pragma once

#include <cstdint>

#include "io/mcap/message_index.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

class chunk_builder {
public:
  chunk_builder() { clear(); }

  // `record` is a whole Schema or Channel record.
  void add_definition(byte_view record) { append_bytes(buffer_, record); }
  void add_message(const message_record& message);

  [[nodiscard]] bool empty() const { return buffer_.size() == chunk_header_bytes; }
  [[nodiscard]] std::uint64_t message_count() const { return index_.message_count(); }
  [[nodiscard]] const message_index& index() const { return index_; }
  // Size of what finish() gives, were it called now.
  [[nodiscard]] std::uint64_t encoded_bytes() const { return buffer_.size() + index_.encoded_bytes(); }

  // Completes the chunk that will stand at `file_offset`; the bytes are in buffer() until clear().
  [[nodiscard]] chunk_index_entry finish(std::uint64_t file_offset);
  [[nodiscard]] byte_view buffer() const { return buffer_; }
  void clear();

private:
  byte_buffer buffer_;
  message_index index_;
};

} // namespace godwit::io::mcap
