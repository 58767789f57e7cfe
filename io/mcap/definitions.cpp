#include "io/mcap/definitions.hpp"

#include <algorithm>

namespace godwit::io::mcap {

template <class Id>
result<bool> definitions::add_to(std::map<Id, byte_buffer>& known, Id id, const record_reader& reader,
                                 const raw_record& raw) {
  const byte_view content = raw.content();
  if (const auto it = known.find(id); it != known.end()) {
    if (!std::ranges::equal(it->second, content)) {
      return tl::make_unexpected(reader.failure(
          errc::malformed, raw.offset, "id " + std::to_string(static_cast<int>(id)) + " defined twice, differently"));
    }
    return false;
  }
  if (content.size() > limits_.definitions_bytes - total_bytes_) {
    return tl::make_unexpected(reader.failure(errc::too_large, raw.offset, "schemas and channels"));
  }
  total_bytes_ += content.size();
  known.emplace(id, byte_buffer(content.begin(), content.end()));
  return true;
}

result<bool> definitions::add(const record_reader& reader, const raw_record& raw, const schema_record& record) {
  if (record.id == schema_id{0}) {
    return tl::make_unexpected(reader.failure(errc::malformed, raw.offset, "schema with id 0"));
  }
  return add_to(schemas_, record.id, reader, raw);
}

result<bool> definitions::add(const record_reader& reader, const raw_record& raw, const channel_record& record) {
  if (record.schema != schema_id{0} && !schemas_.contains(record.schema)) {
    return tl::make_unexpected(reader.failure(errc::malformed, raw.offset, "channel before its schema"));
  }
  return add_to(channels_, record.id, reader, raw);
}

} // namespace godwit::io::mcap
