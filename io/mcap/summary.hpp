// What stands after the data section of an indexed file: it is gathered while the data is written, or scanned, and
// appended in one piece: Data End, the copies of schemas and channels, Statistics, Chunk Index and Metadata Index
// records, Summary Offsets, Footer, magic.
//
// Thread: one at a time. Source: MCAP specification, section "Summary Section".
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/mcap/format.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

// Where the messages of one chunk are: for each channel the log time and the offset of every message.
//
// Used while a chunk is built and while one is scanned for a repair. Cleared and used again for the next chunk, it
// keeps its memory, so that adding a message costs no allocation. Thread: one at a time.
// Source: MCAP specification, records Message Index and Chunk Index.

// The content of a Chunk Index record; offsets and sizes in bytes, offsets from the start of the file.
struct chunk_index_entry {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t chunk_offset = 0;
  std::uint64_t chunk_bytes = 0;
  std::map<channel_id, std::uint64_t> index_offsets; // empty: the chunk has no message index
  std::uint64_t index_bytes = 0;
  std::uint64_t records_bytes = 0;    // as they are when they are read
  std::uint64_t compressed_bytes = 0; // as they stand in the file
  std::string compression;            // empty: they stand there as they are
};

class message_index {
public:
  // `offset` counts from the start of the chunk's records.
  void add(channel_id channel, std::uint64_t log_time_ns, std::uint64_t offset);
  void clear();

  [[nodiscard]] bool has(channel_id channel) const;
  [[nodiscard]] std::size_t channel_count() const { return used_.size(); }
  [[nodiscard]] std::uint64_t message_count() const { return message_count_; }
  [[nodiscard]] std::uint64_t message_count(channel_id channel) const;
  [[nodiscard]] std::uint64_t start_time_ns() const { return message_count_ == 0 ? 0 : start_time_ns_; }
  [[nodiscard]] std::uint64_t end_time_ns() const { return end_time_ns_; }
  [[nodiscard]] const std::vector<channel_id>& channels() const { return used_; }

  // Bytes that append_records will append.
  [[nodiscard]] std::uint64_t encoded_bytes() const;
  // Appends one Message Index record a channel; `file_offset` is where the first one will stand in the file.
  void append_records(byte_buffer& out, std::uint64_t file_offset, chunk_index_entry& entry);

private:
  struct message_place {
    std::uint64_t log_time_ns;
    std::uint64_t offset;
  };
  struct channel_places {
    std::vector<message_place> places;
    bool ordered = true; // by log time; readers want it so, and almost always it is
  };

  std::vector<channel_places> by_channel_; // indexed by channel id
  std::vector<channel_id> used_;           // in the order of their first message
  std::uint64_t message_count_ = 0;
  std::uint64_t start_time_ns_ = UINT64_MAX;
  std::uint64_t end_time_ns_ = 0;
};

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
