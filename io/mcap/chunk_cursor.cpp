#include "io/mcap/chunk_cursor.hpp"

#include <string>

#include "io/mcap/crc.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

namespace {

bool allowed_in_chunk(opcode op) {
  const bool known = op >= opcode::header && op <= opcode::data_end;
  return !known || op == opcode::schema || op == opcode::channel || op == opcode::message;
}

} // namespace

result<chunk_cursor> chunk_cursor::open(const record_reader& reader, const raw_record& chunk, memory& memory) {
  const std::optional<chunk_record> fields = parse_chunk(chunk.content());
  if (!fields) {
    return tl::make_unexpected(reader.failure(errc::malformed, chunk.offset, "chunk record"));
  }
  const bool is_compressed = fields->compression == zstd_name;
  if (!is_compressed && !fields->compression.empty()) {
    const std::string what = "compression " + std::string{fields->compression.substr(0, 32)} + " not supported";
    return tl::make_unexpected(reader.failure(errc::unsupported, chunk.offset, what));
  }
  if (is_compressed && (fields->uncompressed_bytes > reader.limits().record_bytes ||
                        !memory.unpack.decompress(fields->records, fields->uncompressed_bytes, memory.records))) {
    return tl::make_unexpected(reader.failure(errc::malformed, chunk.offset, "chunk that can not be decompressed"));
  }
  const byte_view records = is_compressed ? byte_view{memory.records} : fields->records;
  if (fields->uncompressed_bytes != records.size()) {
    return tl::make_unexpected(reader.failure(errc::malformed, chunk.offset, "chunk with two different sizes"));
  }
  if (fields->crc != 0 && crc_of(records) != fields->crc) {
    return tl::make_unexpected(reader.failure(errc::crc_mismatch, chunk.offset, "chunk"));
  }
  chunk_cursor cursor;
  cursor.reader_ = &reader;
  cursor.records_ = records;
  cursor.compression_ = fields->compression;
  cursor.compressed_bytes_ = fields->records.size();
  cursor.records_offset_ = chunk.offset + static_cast<std::uint64_t>(fields->records.data() - chunk.whole.data());
  return cursor;
}

result<std::optional<raw_record>> chunk_cursor::next() {
  if (at_ == records_.size()) {
    return std::nullopt;
  }
  const byte_view rest = records_.subspan(at_);
  const std::uint64_t offset = records_offset_ + at_;
  if (rest.size() < record_prefix_bytes) {
    return tl::make_unexpected(reader_->failure(errc::malformed, offset, "torn record inside of a chunk"));
  }
  const auto content_bytes = load<std::uint64_t>(rest.data() + 1);
  if (content_bytes > rest.size() - record_prefix_bytes) {
    return tl::make_unexpected(reader_->failure(errc::malformed, offset, "record longer than its chunk"));
  }
  const std::size_t whole_bytes = record_prefix_bytes + static_cast<std::size_t>(content_bytes);
  const opcode op{load<std::uint8_t>(rest.data())};
  if (op == opcode{0} || !allowed_in_chunk(op)) {
    const std::string what = "opcode " + std::to_string(static_cast<int>(op)) + " inside of a chunk";
    return tl::make_unexpected(reader_->failure(errc::malformed, offset, what));
  }
  at_ += whole_bytes;
  return raw_record{op, offset, rest.first(whole_bytes)};
}

} // namespace godwit::io::mcap
