#include "io/mcap/chunk_builder.hpp"

#include <array>

#include "io/mcap/crc.hpp"

namespace godwit::io::mcap {

void chunk_builder::add_message(const message_record& message) {
  index_.add(message.channel, message.log_time_ns, buffer_.size() - chunk_header_bytes);
  // This is the path of every trace record: the fixed part is made on the stack, so that the buffer grows twice only.
  std::array<std::byte, record_prefix_bytes + message_fields_bytes> fixed;
  fixed[0] = static_cast<std::byte>(opcode::message);
  store(fixed.data() + 1, static_cast<std::uint64_t>(message_fields_bytes + message.data.size()));
  store(fixed.data() + 9, static_cast<std::uint16_t>(message.channel));
  store(fixed.data() + 11, message.sequence);
  store(fixed.data() + 15, message.log_time_ns);
  store(fixed.data() + 23, message.publish_time_ns);
  append_bytes(buffer_, fixed);
  append_bytes(buffer_, message.data);
}

chunk_index_entry chunk_builder::finish(std::uint64_t file_offset) {
  const byte_view records = byte_view{buffer_}.subspan(chunk_header_bytes);
  chunk_index_entry entry;
  entry.start_time_ns = index_.start_time_ns();
  entry.end_time_ns = index_.end_time_ns();
  entry.chunk_offset = file_offset;
  entry.chunk_bytes = buffer_.size();
  entry.records_bytes = records.size();

  std::byte* at = buffer_.data();
  at[0] = static_cast<std::byte>(opcode::chunk);
  store(at + 1, static_cast<std::uint64_t>(buffer_.size() - record_prefix_bytes));
  store(at + 9, entry.start_time_ns);
  store(at + 17, entry.end_time_ns);
  store(at + 25, entry.records_bytes);
  store(at + 33, crc_of(records));
  store(at + 37, std::uint32_t{0}); // the name of no compression is empty
  store(at + 41, entry.records_bytes);

  index_.append_records(buffer_, file_offset + entry.chunk_bytes, entry);
  return entry;
}

void chunk_builder::clear() {
  buffer_.clear();
  buffer_.resize(chunk_header_bytes);
  index_.clear();
}

} // namespace godwit::io::mcap
