// The schemas and channels seen so far in a file, and the rules between them and the messages.
//
// An id always means the same; a channel's schema comes before the channel, a channel before its messages. The memory
// is bounded by read_limits::definitions_bytes. Errors: malformed, too_large. Thread: one at a time.
// Source: MCAP specification, records Schema, Channel and Message.
#pragma once

#include <cstdint>
#include <map>

#include "io/mcap/record_reader.hpp"
#include "io/mcap/records.hpp"

namespace godwit::io::mcap {

class definitions {
public:
  explicit definitions(read_limits limits = {}) : limits_{limits} {}

  // True when the id is new. `record` was parsed from `raw`, which came from `reader`.
  [[nodiscard]] result<bool> add(const record_reader& reader, const raw_record& raw, const schema_record& record);
  [[nodiscard]] result<bool> add(const record_reader& reader, const raw_record& raw, const channel_record& record);
  [[nodiscard]] bool has(channel_id channel) const { return channels_.contains(channel); }

private:
  template <class Id>
  [[nodiscard]] result<bool> add_to(std::map<Id, byte_buffer>& known, Id id, const record_reader& reader,
                                    const raw_record& raw);

  read_limits limits_;
  std::map<schema_id, byte_buffer> schemas_;
  std::map<channel_id, byte_buffer> channels_;
  std::size_t total_bytes_ = 0;
};

} // namespace godwit::io::mcap
