#include "io/mcap/channel_registry.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

namespace {

constexpr std::size_t max_ids = UINT16_MAX; // ids are 16 bits wide and ours begin at 1

tl::unexpected<error> refused(errc code, std::string what) {
  return tl::make_unexpected(error{code, {}, std::move(what), 0});
}

tl::unexpected<error> conflict(std::string_view kind, std::string_view name) {
  return refused(errc::invalid_argument, std::string{kind} + " " + std::string{name} + " is known with other content");
}

} // namespace

result<schema_id> channel_registry::add_schema(std::string_view name, std::string_view encoding, byte_view data) {
  const auto known = schema_by_name_.find(std::string{name});
  const auto next = static_cast<std::uint16_t>(schemas_.size() + 1);
  const schema_id id = known == schema_by_name_.end() ? schema_id{next} : known->second;
  if (name.size() + encoding.size() + data.size() > max_definition_bytes) {
    return refused(errc::too_large, "schema " + std::string{name.substr(0, 80)});
  }
  byte_buffer record;
  append_schema(record, {id, name, encoding, data});
  if (known != schema_by_name_.end()) {
    return std::ranges::equal(record_of(id), record) ? result<schema_id>{id} : conflict("schema", name);
  }
  if (schemas_.size() >= max_ids) {
    return refused(errc::too_many, "schemas");
  }
  schemas_.push_back(std::move(record));
  schema_by_name_.emplace(name, id);
  return id;
}

result<channel_id> channel_registry::add_channel(schema_id schema, std::string_view topic,
                                                 std::string_view message_encoding, const string_map& metadata) {
  if (schema != schema_id{0} && !has(schema)) {
    return refused(errc::invalid_argument, "channel " + std::string{topic} + " names an unknown schema");
  }
  const auto known = channel_by_topic_.find(std::string{topic});
  const auto next = static_cast<std::uint16_t>(channels_.size() + 1);
  const channel_id id = known == channel_by_topic_.end() ? channel_id{next} : known->second;
  byte_buffer record;
  append_channel(record, {id, schema, topic, message_encoding, metadata});
  if (record.size() > max_definition_bytes) {
    return refused(errc::too_large, "channel " + std::string{topic.substr(0, 80)});
  }
  if (known != channel_by_topic_.end()) {
    return std::ranges::equal(record_of(id), record) ? result<channel_id>{id} : conflict("channel", topic);
  }
  if (channels_.size() >= max_ids) {
    return refused(errc::too_many, "channels");
  }
  channels_.push_back({schema, std::move(record)});
  channel_by_topic_.emplace(topic, id);
  return id;
}

bool channel_registry::has(schema_id schema) const {
  const auto at = static_cast<std::size_t>(schema);
  return at >= 1 && at <= schemas_.size();
}

bool channel_registry::has(channel_id channel) const {
  const auto at = static_cast<std::size_t>(channel);
  return at >= 1 && at <= channels_.size();
}

schema_id channel_registry::schema_of(channel_id channel) const {
  return channels_.at(static_cast<std::size_t>(channel) - 1).schema;
}

byte_view channel_registry::record_of(schema_id schema) const {
  return schemas_.at(static_cast<std::size_t>(schema) - 1);
}

byte_view channel_registry::record_of(channel_id channel) const {
  return channels_.at(static_cast<std::size_t>(channel) - 1).record;
}

} // namespace godwit::io::mcap
