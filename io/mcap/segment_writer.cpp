#include "io/mcap/segment_writer.hpp"

#include <string>

#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

namespace {

// What one more message costs beyond its record, at most: its index entry, and for a channel that is new to the chunk
// a Message Index record, an entry in the Chunk Index and one in the Statistics.
constexpr std::uint64_t message_overhead_bytes =
    message_index_entry_bytes + message_index_header_bytes + 2 * channel_to_u64_entry_bytes;

std::uint64_t metadata_index_bytes(std::string_view name) { return record_prefix_bytes + 8 + 8 + 4 + name.size(); }

// True when it was not marked before.
bool mark(std::vector<bool>& defined, std::size_t id) {
  if (id >= defined.size()) {
    defined.resize(id + 1);
  }
  const bool is_new = !defined[id];
  defined[id] = true;
  return is_new;
}

} // namespace

result<void> segment_writer::open(const std::filesystem::path& path) {
  if (file_.is_open()) {
    return tl::make_unexpected(error{errc::invalid_argument, path.string(), "the writer has a file open already", 0});
  }
  forget();
  messages_flushed_ = 0;
  messages_lost_ = 0;
  if (auto created = file_.create(path); !created) {
    return created;
  }
  byte_buffer opening;
  append_opening(opening);
  return put(opening);
}

result<void> segment_writer::check_open() const {
  if (failure_) {
    return tl::make_unexpected(*failure_);
  }
  if (!file_.is_open()) {
    return tl::make_unexpected(error{errc::not_open, file_.name(), "the writer has no file open", 0});
  }
  return {};
}

result<void> segment_writer::write(const message_record& message) {
  if (!is_open()) {
    return check_open();
  }
  if (message.data.size() > max_payload_bytes) {
    return tl::make_unexpected(
        error{errc::too_large, file_.name(), "payload of " + std::to_string(message.data.size()) + " bytes", 0});
  }
  if (!is_defined(message.channel)) {
    if (!channels_.has(message.channel)) {
      return tl::make_unexpected(error{errc::invalid_argument, file_.name(), "unknown channel", 0});
    }
    define(message.channel);
  }
  chunk_.add_message(message);
  if (chunk_.encoded_bytes() >= chunk_flush_bytes) {
    return flush();
  }
  return {};
}

bool segment_writer::is_defined(channel_id channel) const {
  const auto id = static_cast<std::size_t>(channel);
  return id < channel_defined_.size() && channel_defined_[id];
}

void segment_writer::define(channel_id channel) {
  const schema_id schema = channels_.schema_of(channel);
  if (schema != schema_id{0} && mark(schema_defined_, static_cast<std::size_t>(schema))) {
    chunk_.add_definition(channels_.record_of(schema));
    summary_.add_schema(channels_.record_of(schema));
  }
  mark(channel_defined_, static_cast<std::size_t>(channel));
  chunk_.add_definition(channels_.record_of(channel));
  summary_.add_channel(channels_.record_of(channel));
}

result<void> segment_writer::add_metadata(std::string_view name, const string_map& values) {
  if (auto open = check_open(); !open) {
    return open;
  }
  const std::size_t at = metadata_.size();
  append_metadata(metadata_, name, values);
  if (metadata_.size() - at > max_payload_bytes) {
    metadata_.resize(at);
    return tl::make_unexpected(error{errc::too_large, file_.name(), "metadata " + std::string{name}, 0});
  }
  metadata_places_.push_back({at, metadata_.size() - at, std::string{name}});
  metadata_index_bytes_ += metadata_index_bytes(name);
  if (metadata_.size() >= chunk_flush_bytes) {
    return flush();
  }
  return {};
}

result<void> segment_writer::flush() {
  if (auto open = check_open(); !open) {
    return open;
  }
  if (!chunk_.empty()) {
    const chunk_index_entry entry = chunk_.finish(file_.size_bytes());
    if (auto written = put(chunk_.encoded()); !written) {
      return written;
    }
    summary_.add_chunk(entry, chunk_.index());
    messages_flushed_ += chunk_.message_count();
    chunk_.clear();
  }
  if (!metadata_.empty()) {
    const std::uint64_t offset = file_.size_bytes();
    if (auto written = put(metadata_); !written) {
      return written;
    }
    for (const pending_metadata& place : metadata_places_) {
      summary_.add_metadata(offset + place.at, place.bytes, place.name);
    }
    metadata_.clear();
    metadata_places_.clear();
    metadata_index_bytes_ = 0;
  }
  return {};
}

result<void> segment_writer::close() {
  if (auto flushed = flush(); !flushed) {
    return flushed;
  }
  byte_buffer tail;
  summary_.append_tail(tail, file_.size_bytes(), data_crc_);
  if (auto written = put(tail); !written) {
    return written;
  }
  forget();
  return file_.close();
}

void segment_writer::abandon() {
  messages_lost_ += chunk_.message_count();
  forget();
  static_cast<void>(file_.close());
}

result<void> segment_writer::put(byte_view bytes) {
  if (auto written = file_.append(bytes); !written) {
    failure_ = written.error();
    messages_lost_ += chunk_.message_count();
    chunk_.clear();
    return written;
  }
  data_crc_ = crc_of(bytes, data_crc_);
  return {};
}

void segment_writer::forget() {
  failure_.reset();
  data_crc_ = 0;
  chunk_.clear();
  summary_ = {};
  metadata_.clear();
  metadata_places_.clear();
  metadata_index_bytes_ = 0;
  schema_defined_.clear();
  channel_defined_.clear();
}

std::uint64_t segment_writer::closed_bytes() const {
  // The open chunk is counted also while it is empty: the next message needs one.
  const std::uint64_t chunk_index =
      chunk_index_header_bytes + zstd_name.size() + chunk_.index().channel_count() * channel_to_u64_entry_bytes;
  const std::uint64_t counts = chunk_.index().channel_count() * channel_to_u64_entry_bytes;
  return file_.size_bytes() + chunk_.encoded_bytes() + metadata_.size() + summary_.tail_bytes() + chunk_index + counts +
         metadata_index_bytes_;
}

std::uint64_t segment_writer::closed_bytes_with(channel_id channel, std::size_t payload_bytes) const {
  std::uint64_t total =
      closed_bytes() + record_prefix_bytes + message_fields_bytes + payload_bytes + message_overhead_bytes;
  if (!is_defined(channel) && channels_.has(channel)) { // once in the chunk and once in the summary
    const schema_id schema = channels_.schema_of(channel);
    total += 2 * channels_.record_of(channel).size();
    total += schema == schema_id{0} ? 0 : 2 * channels_.record_of(schema).size();
  }
  return total;
}

std::uint64_t segment_writer::closed_bytes_with(std::string_view name, const string_map& values) const {
  byte_buffer record;
  append_metadata(record, name, values);
  return closed_bytes() + record.size() + metadata_index_bytes(name);
}

} // namespace godwit::io::mcap
