// What stands after the data section of an indexed file: it is gathered while the data is written, or scanned, and
// appended in one piece: Data End, the copies of schemas and channels, Statistics, Chunk Index and Metadata Index
// records, Summary Offsets, Footer, magic.
//
// Thread: one at a time. Source: MCAP specification, section "Summary Section".
#pragma once

#include <cstdint>
#include <string_view>

#include "io/mcap/message_index.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

class summary {
public:
  // `record` is the whole record with its prefix, each id at most once.
  void add_schema(byte_view record);
  void add_channel(byte_view record);
  // `index` holds the messages of this chunk, for the statistics.
  void add_chunk(const chunk_index_entry& entry, const message_index& index);
  // A message that stands outside of chunks (files of others). An index would hide it from readers, so that from the
  // first one on no chunk index is written.
  void add_message(const message_record& message);
  void add_metadata(std::uint64_t offset, std::uint64_t record_bytes, std::string_view name);

  [[nodiscard]] const statistics_record& statistics() const { return statistics_; }
  // Bytes that append_tail would append now.
  [[nodiscard]] std::uint64_t tail_bytes() const;
  // `file_offset`: where the tail will begin; `data_crc`: of all bytes of the file before it.
  void append_tail(byte_buffer& out, std::uint64_t file_offset, std::uint32_t data_crc) const;

private:
  void count(channel_id channel, std::uint64_t messages, std::uint64_t start_time_ns, std::uint64_t end_time_ns);
  // Returns the file offset of the summary offsets.
  std::uint64_t append_groups(byte_buffer& out, std::uint64_t file_offset) const;

  statistics_record statistics_;
  byte_buffer schemas_;
  byte_buffer channels_;
  byte_buffer chunk_indexes_;
  byte_buffer metadata_indexes_;
  bool has_loose_messages_ = false;
};

} // namespace godwit::io::mcap
