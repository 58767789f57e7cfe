// The schemas and channels of a recording, under ids that stay the same in all of its segments.
//
// A segment takes from here the records it needs when a channel is used for the first time in it. Asking again for the
// same schema or channel gives the same id. Bounds: 65535 of each, max_definition_bytes for a single one; names,
// encodings and data are copied. Errors: too_many, too_large, invalid_argument. Thread: one at a time.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/mcap/error.hpp"
#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

class channel_registry {
public:
  static constexpr std::size_t max_definition_bytes = std::size_t{256} << 10; // a schema of ours has a few KiB

  [[nodiscard]] result<schema_id> add_schema(std::string_view name, std::string_view encoding, byte_view data);
  // One topic has one channel: the same topic with another schema, encoding or metadata is an error.
  [[nodiscard]] result<channel_id> add_channel(schema_id schema, std::string_view topic,
                                               std::string_view message_encoding, const string_map& metadata = {});

  [[nodiscard]] bool has(channel_id channel) const;
  [[nodiscard]] schema_id schema_of(channel_id channel) const;
  // The whole record with its prefix. The id must come from this registry.
  [[nodiscard]] byte_view record_of(schema_id schema) const;
  [[nodiscard]] byte_view record_of(channel_id channel) const;

private:
  struct channel_entry {
    schema_id schema{};
    byte_buffer record;
  };
  [[nodiscard]] bool has(schema_id schema) const;

  std::vector<byte_buffer> schemas_;    // the one with id i stands at i - 1
  std::vector<channel_entry> channels_; // likewise
  std::unordered_map<std::string, schema_id> schema_by_name_;
  std::unordered_map<std::string, channel_id> channel_by_topic_;
};

} // namespace godwit::io::mcap
