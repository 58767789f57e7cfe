#include "io/mcap/records.hpp"

#include <utility>

namespace godwit::io::mcap {

namespace {

// Takes fields off the front of a record's content. Once a field does not fit, every further one is empty and ok() is
// false: so a parser reads all of its fields and asks once.
class field_reader {
public:
  explicit field_reader(byte_view content) : rest_{content} {}

  template <std::unsigned_integral T>
  T integer() {
    const byte_view field = take(sizeof(T));
    return field.size() == sizeof(T) ? load<T>(field.data()) : T{0};
  }
  byte_view take(std::uint64_t size_bytes) {
    if (size_bytes > rest_.size()) {
      ok_ = false;
      rest_ = {};
      return {};
    }
    const byte_view field = rest_.first(static_cast<std::size_t>(size_bytes));
    rest_ = rest_.subspan(field.size());
    return field;
  }
  std::string_view string() {
    const byte_view field = take(integer<std::uint32_t>());
    return {reinterpret_cast<const char*>(field.data()), field.size()};
  }
  string_map strings() {
    field_reader entries{take(integer<std::uint32_t>())};
    string_map values;
    while (!entries.done()) {
      const std::string_view key = entries.string();
      const std::string_view value = entries.string();
      values.emplace(key, value);
    }
    ok_ = ok_ && entries.ok();
    return values;
  }
  byte_view rest() { return std::exchange(rest_, {}); }

  [[nodiscard]] bool done() const { return rest_.empty(); }
  [[nodiscard]] bool ok() const { return ok_; }

private:
  byte_view rest_;
  bool ok_ = true;
};

template <class Record>
std::optional<Record> when_ok(const field_reader& fields, Record record) {
  if (!fields.ok()) {
    return std::nullopt;
  }
  return record;
}

void append_strings(byte_buffer& out, const string_map& values) {
  const std::size_t length_at = out.size();
  append_integer(out, std::uint32_t{0});
  for (const auto& [key, value] : values) {
    append_string(out, key);
    append_string(out, value);
  }
  store(out.data() + length_at, static_cast<std::uint32_t>(out.size() - length_at - sizeof(std::uint32_t)));
}

} // namespace

// The fields of a braced initializer are read in the order in which they are written, which is that of the file.

std::optional<header_record> parse_header(byte_view content) {
  field_reader fields{content};
  header_record record{fields.string(), fields.string()};
  return when_ok(fields, record);
}

std::optional<schema_record> parse_schema(byte_view content) {
  field_reader fields{content};
  schema_record record{schema_id{fields.integer<std::uint16_t>()}, fields.string(), fields.string(),
                       fields.take(fields.integer<std::uint32_t>())};
  return when_ok(fields, record);
}

std::optional<channel_record> parse_channel(byte_view content) {
  field_reader fields{content};
  channel_record record{channel_id{fields.integer<std::uint16_t>()}, schema_id{fields.integer<std::uint16_t>()},
                        fields.string(), fields.string(), fields.strings()};
  return when_ok(fields, std::move(record));
}

std::optional<message_record> parse_message(byte_view content) {
  field_reader fields{content};
  message_record record{channel_id{fields.integer<std::uint16_t>()}, fields.integer<std::uint32_t>(),
                        fields.integer<std::uint64_t>(), fields.integer<std::uint64_t>(), fields.rest()};
  return when_ok(fields, record);
}

std::optional<chunk_record> parse_chunk(byte_view content) {
  field_reader fields{content};
  chunk_record record{fields.integer<std::uint64_t>(),
                      fields.integer<std::uint64_t>(),
                      fields.integer<std::uint64_t>(),
                      fields.integer<std::uint32_t>(),
                      fields.string(),
                      fields.take(fields.integer<std::uint64_t>())};
  return when_ok(fields, record);
}

std::optional<message_index_record> parse_message_index(byte_view content) {
  field_reader fields{content};
  message_index_record record{channel_id{fields.integer<std::uint16_t>()}};
  fields.take(fields.integer<std::uint32_t>());
  return when_ok(fields, record);
}

std::optional<metadata_record> parse_metadata(byte_view content) {
  field_reader fields{content};
  metadata_record record{fields.string(), fields.strings()};
  return when_ok(fields, std::move(record));
}

std::optional<statistics_record> parse_statistics(byte_view content) {
  field_reader fields{content};
  statistics_record record{
      fields.integer<std::uint64_t>(), fields.integer<std::uint16_t>(), fields.integer<std::uint32_t>(),
      fields.integer<std::uint32_t>(), fields.integer<std::uint32_t>(), fields.integer<std::uint32_t>(),
      fields.integer<std::uint64_t>(), fields.integer<std::uint64_t>(), {}};
  field_reader counts{fields.take(fields.integer<std::uint32_t>())};
  while (!counts.done()) {
    const channel_id channel{counts.integer<std::uint16_t>()};
    record.channel_message_counts[channel] = counts.integer<std::uint64_t>();
  }
  return counts.ok() ? when_ok(fields, std::move(record)) : std::nullopt;
}

std::optional<data_end_record> parse_data_end(byte_view content) {
  field_reader fields{content};
  data_end_record record{fields.integer<std::uint32_t>()};
  return when_ok(fields, record);
}

std::optional<footer_record> parse_footer(byte_view content) {
  field_reader fields{content};
  footer_record record{fields.integer<std::uint64_t>(), fields.integer<std::uint64_t>(),
                       fields.integer<std::uint32_t>()};
  return content.size() == footer_bytes - record_prefix_bytes ? when_ok(fields, record) : std::nullopt;
}

void append_opening(byte_buffer& out) {
  append_bytes(out, magic);
  const std::size_t start = begin_record(out, opcode::header);
  append_string(out, "");
  append_string(out, "godwit " GODWIT_VERSION);
  end_record(out, start);
}

void append_schema(byte_buffer& out, const schema_record& schema) {
  const std::size_t start = begin_record(out, opcode::schema);
  append_integer(out, static_cast<std::uint16_t>(schema.id));
  append_string(out, schema.name);
  append_string(out, schema.encoding);
  append_integer(out, static_cast<std::uint32_t>(schema.data.size()));
  append_bytes(out, schema.data);
  end_record(out, start);
}

void append_channel(byte_buffer& out, const channel_record& channel) {
  const std::size_t start = begin_record(out, opcode::channel);
  append_integer(out, static_cast<std::uint16_t>(channel.id));
  append_integer(out, static_cast<std::uint16_t>(channel.schema));
  append_string(out, channel.topic);
  append_string(out, channel.message_encoding);
  append_strings(out, channel.metadata);
  end_record(out, start);
}

void append_metadata(byte_buffer& out, std::string_view name, const string_map& values) {
  const std::size_t start = begin_record(out, opcode::metadata);
  append_string(out, name);
  append_strings(out, values);
  end_record(out, start);
}

void append_statistics(byte_buffer& out, const statistics_record& statistics) {
  const std::size_t start = begin_record(out, opcode::statistics);
  append_integer(out, statistics.message_count);
  append_integer(out, statistics.schema_count);
  append_integer(out, statistics.channel_count);
  append_integer(out, statistics.attachment_count);
  append_integer(out, statistics.metadata_count);
  append_integer(out, statistics.chunk_count);
  append_integer(out, statistics.start_time_ns);
  append_integer(out, statistics.end_time_ns);
  const std::size_t entries = statistics.channel_message_counts.size();
  append_integer(out, static_cast<std::uint32_t>(entries * channel_to_u64_entry_bytes));
  for (const auto& [channel, count] : statistics.channel_message_counts) {
    append_integer(out, static_cast<std::uint16_t>(channel));
    append_integer(out, count);
  }
  end_record(out, start);
}

void append_data_end(byte_buffer& out, std::uint32_t crc) {
  const std::size_t start = begin_record(out, opcode::data_end);
  append_integer(out, crc);
  end_record(out, start);
}

} // namespace godwit::io::mcap
