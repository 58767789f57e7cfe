// Reads an MCAP file from front to back: schemas, channels, messages and metadata in the order of the file, out of
// chunks (as they are, or compressed with Zstandard) and outside of chunks, then how the file ends. For tests of what
// godwit writes, and of what it repairs; godwit itself reads with salvage_reader, which forgives.
//
// Checked: structure, ids, the CRC of every chunk, of the data section and of the summary. A file that is still being
// written, or whose writer was killed, ends with `truncated`: everything before it is whole (a torn chunk is left out
// entirely, since its CRC can not be checked). Records that we do not use (attachments, indexes, unknown opcodes) are
// skipped. Errors: io, malformed, crc_mismatch, unsupported ("compression X not supported"), too_large, each with the
// offset. After an end or an error every further call gives the same again. Thread: one at a time.
// Source: MCAP specification, https://mcap.dev/spec
#pragma once

#include <optional>
#include <variant>

#include "io/mcap/chunks.hpp"
#include "io/mcap/record_reader.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

class strict_mcap_reader {
public:
  using item = std::variant<header_record, schema_record, channel_record, message_record, metadata_record,
                            statistics_record, end_of_file, truncated>;

  // The source must outlive the reader.
  explicit strict_mcap_reader(const byte_source& source, read_limits limits = {})
      : reader_{source, limits}, definitions_{limits} {}

  // Views in the item are valid until the next call.
  [[nodiscard]] result<item> next();

private:
  using step = result<std::optional<item>>; // nullopt: nothing to tell, go on

  [[nodiscard]] step step_start();
  [[nodiscard]] step step_file();
  [[nodiscard]] step step_end();
  [[nodiscard]] step on_record(const raw_record& raw);
  [[nodiscard]] step on_content(const raw_record& raw);
  [[nodiscard]] step on_header(const raw_record& raw);
  [[nodiscard]] step on_data_end(const raw_record& raw);
  [[nodiscard]] step on_footer(const raw_record& raw);
  [[nodiscard]] step malformed(const raw_record& raw, std::string what) const;

  // The parts of a file in their order.
  enum class part { start, header, data, summary, end };

  record_reader reader_;
  definitions definitions_;
  chunk_cursor::memory memory_; // of chunk_
  std::optional<chunk_cursor> chunk_;
  part part_ = part::start;
  std::uint64_t summary_start_ = 0;
  std::uint64_t end_offset_ = 0;
  std::optional<result<item>> last_; // end or error
};

} // namespace godwit::io::mcap
