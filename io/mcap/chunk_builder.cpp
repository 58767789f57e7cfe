#include "io/mcap/chunk_builder.hpp"

#include <array>

#include "io/mcap/crc.hpp"

namespace godwit::io::mcap {

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

// Behind the name of their compression, and how long they are then.
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

} // namespace godwit::io::mcap
