// Reads whatever can be read of a file: one that is being written, one that a SIGKILL has cut, one with damage
// anywhere.
//
//   record ──sound──> told, or walked through (chunk)          damage ──> `unreadable`, with its place and the reason
//                                                                 └──> on after it: at the next record if one stands
//                                                                      there, else at the next chunk whose CRC holds
//
// It gives nothing up for one wrong byte, and asks for no order of the records: whoever reads resolves channels by
// itself, and a message may come whose channel stood in the damage. A chunk is taken whole or not
// at all, since its CRC covers all of it. Searching costs at most search_factor times the file.
// Errors: io alone. Memory: one record, read_limits. Thread: one at a time. Source: MCAP specification, "Records".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "io/mcap/chunks.hpp"
#include "io/mcap/record_reader.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

struct unreadable {
  std::uint64_t offset = 0; // in the file
  std::uint64_t bytes = 0;
  bool is_cut = false;            // the file ends without its end: it is being written, or its writer was killed
  bool may_hold_messages = false; // false: only the index after the messages, or nothing at all
  std::string why;
};

class salvage_reader {
public:
  static constexpr std::size_t read_ahead_bytes = std::size_t{2} << 20;
  static constexpr std::uint64_t search_factor = 8; // bytes that CRCs are tried on, in sizes of the file

  using item = std::variant<schema_record, channel_record, message_record, metadata_record, unreadable, end_of_file>;

  // The source must outlive the reader. What it grows by later is not read: another reader goes on at BEGIN, where this
  // one found the file cut.
  explicit salvage_reader(const byte_source& source, read_limits limits = {}, std::uint64_t begin = 0)
      : source_{source}, limits_{limits}, size_bytes_{source.size_bytes()}, offset_{begin}, has_started_{begin != 0} {}

  // Views in the item are valid until the next call. After end_of_file or an error every call gives the same again.
  [[nodiscard]] result<item> next();

private:
  using step = result<std::optional<item>>; // nullopt: nothing to tell, go on

  [[nodiscard]] step step_start();
  [[nodiscard]] step step_record();
  [[nodiscard]] step step_in_chunk();
  [[nodiscard]] step on_record(opcode op, byte_view content);
  [[nodiscard]] step on_message_index(byte_view content);
  [[nodiscard]] step on_chunk(byte_view content);
  [[nodiscard]] step on_end_mark();
  [[nodiscard]] std::optional<byte_view> records_of(const chunk_record& chunk);
  [[nodiscard]] step lose_from(std::uint64_t offset, std::string why);
  [[nodiscard]] step lose_record(std::string why);
  [[nodiscard]] result<bool> is_chunk_by_another_name(opcode op, std::uint64_t whole_bytes);
  [[nodiscard]] result<bool> stands_record_at(std::uint64_t offset);
  [[nodiscard]] result<std::optional<std::uint64_t>> find_chunk(std::uint64_t from);
  [[nodiscard]] result<bool> is_sound_chunk(std::uint64_t offset, byte_view head);
  [[nodiscard]] result<byte_view> view(std::uint64_t offset, std::uint64_t bytes);
  [[nodiscard]] unreadable lost(std::uint64_t offset, std::uint64_t bytes, std::string why) const;

  const byte_source& source_;
  read_limits limits_;
  const std::uint64_t size_bytes_;
  byte_buffer window_; // a part of the file
  std::uint64_t window_offset_ = 0;
  std::size_t window_bytes_ = 0;
  std::uint64_t offset_;           // of the next record
  std::uint64_t next_offset_ = 0;  // after the record that is being looked at
  byte_view chunk_;                // what is left of the records in a chunk
  bool is_compressed_ = false;     // they stand in unpacked_
  std::uint64_t chunk_offset_ = 0; // of its record
  decompressor unpack_;
  byte_buffer unpacked_;
  std::uint64_t searched_bytes_ = 0;
  bool has_started_;
  bool is_after_data_ = false; // the end of the data section was seen
  bool is_done_ = false;
};

} // namespace godwit::io::mcap
