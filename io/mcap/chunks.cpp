#include "io/mcap/chunks.hpp"

#include <array>
#include <string>

#include <zstd.h>

#include "io/mcap/format.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

namespace {

constexpr int level = 3; // Zstandard's own default

} // namespace

struct compressor::context {
  context() : made(ZSTD_createCCtx()) {}
  context(const context&) = delete;
  context& operator=(const context&) = delete;
  ~context() { ZSTD_freeCCtx(made); }
  ZSTD_CCtx* const made;
};

compressor::compressor() = default;
compressor::~compressor() = default;
compressor::compressor(compressor&&) noexcept = default;
compressor& compressor::operator=(compressor&&) noexcept = default;

bool compressor::compress(byte_view records, byte_buffer& out) {
  if (!context_)
    context_ = std::make_unique<context>();
  if (context_->made == nullptr)
    return false;
  const auto before = out.size();
  out.resize(before + records.size()); // less than that, or it is not worth it
  const auto bytes =
      ZSTD_compressCCtx(context_->made, out.data() + before, records.size(), records.data(), records.size(), level);
  const bool is_smaller = ZSTD_isError(bytes) == 0;
  out.resize(before + (is_smaller ? bytes : 0));
  return is_smaller;
}

struct decompressor::context {
  context() : made(ZSTD_createDCtx()) {}
  context(const context&) = delete;
  context& operator=(const context&) = delete;
  ~context() { ZSTD_freeDCtx(made); }
  ZSTD_DCtx* const made;
};

decompressor::decompressor() = default;
decompressor::~decompressor() = default;
decompressor::decompressor(decompressor&&) noexcept = default;
decompressor& decompressor::operator=(decompressor&&) noexcept = default;

bool decompressor::decompress(byte_view compressed, std::uint64_t records_bytes, byte_buffer& out) {
  if (!context_)
    context_ = std::make_unique<context>();
  if (context_->made == nullptr)
    return false;
  out.resize(static_cast<std::size_t>(records_bytes));
  const auto bytes = ZSTD_decompressDCtx(context_->made, out.data(), out.size(), compressed.data(), compressed.size());
  return ZSTD_isError(bytes) == 0 && bytes == records_bytes;
}

void chunk_builder::add_message(const message_record& message) {
  index_.add(message.channel, message.log_time_ns, records_.size());
  // This is the path of every trace record: the fixed part is made on the stack, so that the buffer grows twice only.
  std::array<std::byte, record_prefix_bytes + message_fields_bytes> fixed;
  fixed[0] = static_cast<std::byte>(opcode::message);
  store(fixed.data() + 1, static_cast<std::uint64_t>(message_fields_bytes + message.data.size()));
  store(fixed.data() + 9, static_cast<std::uint16_t>(message.channel));
  store(fixed.data() + 11, message.sequence);
  store(fixed.data() + 15, message.log_time_ns);
  store(fixed.data() + 23, message.publish_time_ns);
  append_bytes(records_, fixed);
  append_bytes(records_, message.data);
}

chunk_index_entry chunk_builder::finish(std::uint64_t file_offset) {
  chunk_index_entry entry;
  entry.start_time_ns = index_.start_time_ns();
  entry.end_time_ns = index_.end_time_ns();
  entry.chunk_offset = file_offset;
  entry.records_bytes = records_.size();

  encoded_.clear();
  const auto start = begin_record(encoded_, opcode::chunk);
  append_integer(encoded_, entry.start_time_ns);
  append_integer(encoded_, entry.end_time_ns);
  append_integer(encoded_, entry.records_bytes);
  append_integer(encoded_, crc_of(records_));
  append_records(entry);
  end_record(encoded_, start);
  entry.chunk_bytes = encoded_.size();
  index_.append_records(encoded_, file_offset + entry.chunk_bytes, entry);
  return entry;
}

// After the name of their compression, and how long they are then.
void chunk_builder::append_records(chunk_index_entry& entry) {
  const auto name_at = encoded_.size();
  append_string(encoded_, zstd_name);
  const auto length_at = encoded_.size();
  append_integer(encoded_, std::uint64_t{0});
  const auto records_at = encoded_.size();
  if (records_.size() >= compressed_from_bytes && compressor_.compress(records_, encoded_)) {
    entry.compression = zstd_name;
    entry.compressed_bytes = encoded_.size() - records_at;
    store(encoded_.data() + length_at, entry.compressed_bytes);
    return;
  }
  encoded_.resize(name_at);
  append_string(encoded_, {});
  entry.compressed_bytes = entry.records_bytes;
  append_integer(encoded_, entry.compressed_bytes);
  append_bytes(encoded_, records_);
}

void chunk_builder::clear() {
  records_.clear();
  encoded_.clear();
  index_.clear();
}

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
