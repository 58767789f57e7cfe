// The records of a file one after the other, not interpreted: where each one stands, and whether the end is torn.
//
// Memory is bounded by read_limits: a length found in the file is checked against it, and the buffer grows only as far
// as bytes really arrive. Errors: io; malformed with the offset. Thread: one at a time.
// Source: MCAP specification, section "Records".
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>

#include "io/mcap/byte_source.hpp"
#include "io/mcap/error.hpp"
#include "io/mcap/format.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

struct read_limits {
  std::size_t record_bytes = std::size_t{16} << 20;      // a whole chunk; ours end a little above 1 MiB
  std::size_t definitions_bytes = std::size_t{16} << 20; // all schemas and channels of a file together
};

struct raw_record {
  opcode op{};
  std::uint64_t offset = 0; // from the start of the file
  byte_view whole;          // with the prefix; valid until the next call of the reader
  [[nodiscard]] byte_view content() const { return whole.subspan(record_prefix_bytes); }
};

// The file ends before its end mark: the writer is still at work, or was killed.
struct truncated {
  std::uint64_t record_offset = 0; // what stands before this offset is whole
  std::uint64_t file_bytes = 0;    // where the bytes end
};

struct end_of_file {
  std::uint64_t file_bytes = 0;
};

class record_reader {
public:
  explicit record_reader(const byte_source& source, read_limits limits = {}) : source_{source}, limits_{limits} {}

  using magic_outcome = std::variant<std::monostate, truncated>;
  using outcome = std::variant<raw_record, truncated>;

  // At the start of the file, and after the footer.
  [[nodiscard]] result<magic_outcome> read_magic();
  // Zeros up to the end of the file count as truncated: after a loss of power a file system may leave them.
  [[nodiscard]] result<outcome> next();
  // True when nothing stands after what was read so far.
  [[nodiscard]] result<bool> at_end();

  // CRC of all bytes before the record that was read last, from the start or from restart_crc() on.
  [[nodiscard]] std::uint32_t crc() const { return crc_; }
  // The CRC starts anew after the record that was read last.
  void restart_crc();

  [[nodiscard]] const read_limits& limits() const { return limits_; }
  [[nodiscard]] error failure(errc code, std::uint64_t offset, std::string what) const;

private:
  [[nodiscard]] result<bool> ensure(std::size_t bytes);
  [[nodiscard]] result<bool> only_zeros_left() const;
  [[nodiscard]] byte_view available() const { return byte_view{buffer_}.subspan(begin_); }
  [[nodiscard]] truncated truncated_here() const { return {offset_, offset_ + available().size()}; }
  void consume();

  const byte_source& source_;
  read_limits limits_;
  byte_buffer buffer_;       // a window on the file
  std::size_t begin_ = 0;    // what stands before it in the window is consumed
  std::uint64_t offset_ = 0; // of `begin_` in the file
  std::size_t current_bytes_ = 0;
  std::uint32_t crc_ = 0;
  bool crc_skips_current_ = false;
};

// The schemas and channels seen so far in a file, and the rules between them and the messages.
//
// An id always means the same; a channel's schema comes before the channel, a channel before its messages. The memory
// is bounded by read_limits::definitions_bytes. Errors: malformed, too_large. Thread: one at a time.
// Source: MCAP specification, records Schema, Channel and Message.
class definitions {
public:
  explicit definitions(read_limits limits = {}) : limits_{limits} {}

  // True when the id is new. `record` was parsed from `raw`, which came from `reader`.
  [[nodiscard]] result<bool> add(const record_reader& reader, const raw_record& raw, const schema_record& record);
  [[nodiscard]] result<bool> add(const record_reader& reader, const raw_record& raw, const channel_record& record);
  [[nodiscard]] bool has(channel_id channel) const { return channels_.contains(channel); }

private:
  template <class Id>
  [[nodiscard]] result<bool> add_to(std::map<Id, byte_buffer>& known, Id id, const record_reader& reader,
                                    const raw_record& raw);

  read_limits limits_;
  std::map<schema_id, byte_buffer> schemas_;
  std::map<channel_id, byte_buffer> channels_;
  std::size_t total_bytes_ = 0;
};

} // namespace godwit::io::mcap
