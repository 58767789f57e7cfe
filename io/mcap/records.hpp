// MCAP records as values, and between values and bytes.
//
// Parsed records are views into the bytes they were parsed from. Parsing gives nullopt when the fields do not fit into
// the content; bytes after the last known field are ignored, as the specification asks. Times in nanoseconds.
// Thread: plain values and pure functions. Source: MCAP specification, https://mcap.dev/spec#records
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

struct header_record {
  std::string_view profile;
  std::string_view library;
};

struct schema_record {
  schema_id id{};
  std::string_view name;
  std::string_view encoding;
  byte_view data;
};

struct channel_record {
  channel_id id{};
  schema_id schema{};
  std::string_view topic;
  std::string_view message_encoding;
  string_map metadata;
};

struct message_record {
  channel_id channel{};
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  byte_view data;
};

struct chunk_record {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t uncompressed_bytes = 0;
  std::uint32_t crc = 0; // 0: not available
  std::string_view compression;
  byte_view records;
};

struct message_index_record { // the entries are not needed by anyone here: a repair makes them anew from the chunk
  channel_id channel{};
};

struct metadata_record {
  std::string_view name;
  string_map values;
};

struct statistics_record {
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t attachment_count = 0;
  std::uint32_t metadata_count = 0;
  std::uint32_t chunk_count = 0;
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::map<channel_id, std::uint64_t> channel_message_counts;
};

struct data_end_record {
  std::uint32_t crc = 0; // 0: not available
};

struct footer_record {
  std::uint64_t summary_start = 0;        // 0: the file has no summary
  std::uint64_t summary_offset_start = 0; // 0: the file has no summary offsets
  std::uint32_t summary_crc = 0;          // 0: not available
};

[[nodiscard]] std::optional<header_record> parse_header(byte_view content);
[[nodiscard]] std::optional<schema_record> parse_schema(byte_view content);
[[nodiscard]] std::optional<channel_record> parse_channel(byte_view content);
[[nodiscard]] std::optional<message_record> parse_message(byte_view content);
[[nodiscard]] std::optional<chunk_record> parse_chunk(byte_view content);
[[nodiscard]] std::optional<message_index_record> parse_message_index(byte_view content);
[[nodiscard]] std::optional<metadata_record> parse_metadata(byte_view content);
[[nodiscard]] std::optional<statistics_record> parse_statistics(byte_view content);
[[nodiscard]] std::optional<data_end_record> parse_data_end(byte_view content);
[[nodiscard]] std::optional<footer_record> parse_footer(byte_view content);

// The opening of every file of ours: magic and header record.
void append_opening(byte_buffer& out);
void append_schema(byte_buffer& out, const schema_record& schema);
void append_channel(byte_buffer& out, const channel_record& channel);
void append_metadata(byte_buffer& out, std::string_view name, const string_map& values);
void append_statistics(byte_buffer& out, const statistics_record& statistics);
void append_data_end(byte_buffer& out, std::uint32_t crc);

} // namespace godwit::io::mcap
