#include "io/mcap/summary.hpp"

#include <algorithm>
#include <array>

#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

void summary::add_schema(byte_view record) {
  append_bytes(schemas_, record);
  ++statistics_.schema_count;
}

void summary::add_channel(byte_view record) {
  append_bytes(channels_, record);
  ++statistics_.channel_count;
}

void summary::add_chunk(const chunk_index_entry& entry, const message_index& index) {
  ++statistics_.chunk_count;
  for (const channel_id channel : index.channels()) {
    count(channel, index.message_count(channel), index.start_time_ns(), index.end_time_ns());
  }
  const std::size_t start = begin_record(chunk_indexes_, opcode::chunk_index);
  append_integer(chunk_indexes_, entry.start_time_ns);
  append_integer(chunk_indexes_, entry.end_time_ns);
  append_integer(chunk_indexes_, entry.chunk_offset);
  append_integer(chunk_indexes_, entry.chunk_bytes);
  append_integer(chunk_indexes_, static_cast<std::uint32_t>(entry.index_offsets.size() * channel_to_u64_entry_bytes));
  for (const auto& [channel, offset] : entry.index_offsets) {
    append_integer(chunk_indexes_, static_cast<std::uint16_t>(channel));
    append_integer(chunk_indexes_, offset);
  }
  append_integer(chunk_indexes_, entry.index_bytes);
  append_string(chunk_indexes_, entry.compression);
  append_integer(chunk_indexes_, entry.compressed_bytes);
  append_integer(chunk_indexes_, entry.records_bytes);
  end_record(chunk_indexes_, start);
}

void summary::add_message(const message_record& message) {
  has_loose_messages_ = true;
  count(message.channel, 1, message.log_time_ns, message.log_time_ns);
}

void summary::add_metadata(std::uint64_t offset, std::uint64_t record_bytes, std::string_view name) {
  ++statistics_.metadata_count;
  const std::size_t start = begin_record(metadata_indexes_, opcode::metadata_index);
  append_integer(metadata_indexes_, offset);
  append_integer(metadata_indexes_, record_bytes);
  append_string(metadata_indexes_, name);
  end_record(metadata_indexes_, start);
}

void summary::count(channel_id channel, std::uint64_t messages, std::uint64_t start_time_ns,
                    std::uint64_t end_time_ns) {
  const bool first = statistics_.message_count == 0;
  statistics_.start_time_ns = first ? start_time_ns : std::min(statistics_.start_time_ns, start_time_ns);
  statistics_.end_time_ns = std::max(statistics_.end_time_ns, end_time_ns);
  statistics_.message_count += messages;
  statistics_.channel_message_counts[channel] += messages;
}

std::uint64_t summary::tail_bytes() const {
  const std::size_t counts_bytes = statistics_.channel_message_counts.size() * channel_to_u64_entry_bytes;
  constexpr std::size_t group_count_max = 5;
  return data_end_bytes + schemas_.size() + channels_.size() + statistics_header_bytes + counts_bytes +
         chunk_indexes_.size() + metadata_indexes_.size() + group_count_max * summary_offset_bytes + footer_bytes +
         magic.size();
}

std::uint64_t summary::append_groups(byte_buffer& out, std::uint64_t file_offset) const {
  struct group {
    opcode op;
    byte_view records;
  };
  byte_buffer statistics;
  append_statistics(statistics, statistics_);
  const byte_view chunk_indexes = has_loose_messages_ ? byte_view{} : byte_view{chunk_indexes_};
  const std::array<group, 5> groups{{{opcode::schema, schemas_},
                                     {opcode::channel, channels_},
                                     {opcode::statistics, statistics},
                                     {opcode::chunk_index, chunk_indexes},
                                     {opcode::metadata_index, metadata_indexes_}}};
  byte_buffer offsets;
  std::uint64_t group_start = file_offset;
  for (const group& g : groups) {
    if (g.records.empty()) {
      continue;
    }
    append_bytes(out, g.records);
    const std::size_t start = begin_record(offsets, opcode::summary_offset);
    append_integer(offsets, static_cast<std::uint8_t>(g.op));
    append_integer(offsets, group_start);
    append_integer(offsets, static_cast<std::uint64_t>(g.records.size()));
    end_record(offsets, start);
    group_start += g.records.size();
  }
  append_bytes(out, offsets);
  return group_start;
}

void summary::append_tail(byte_buffer& out, std::uint64_t file_offset, std::uint32_t data_crc) const {
  append_data_end(out, data_crc);
  const std::size_t summary_at = out.size();
  const std::uint64_t summary_start = file_offset + data_end_bytes;
  const std::uint64_t summary_offset_start = append_groups(out, summary_start);
  const std::size_t footer = begin_record(out, opcode::footer);
  append_integer(out, summary_start);
  append_integer(out, summary_offset_start);
  // The footer's own length belongs to what its CRC covers, so it is filled in before the CRC is computed.
  append_integer(out, std::uint32_t{0});
  end_record(out, footer);
  const std::size_t crc_at = out.size() - sizeof(std::uint32_t);
  store(out.data() + crc_at, crc_of(byte_view{out}.subspan(summary_at, crc_at - summary_at)));
  append_bytes(out, magic);
}

void message_index::add(channel_id channel, std::uint64_t log_time_ns, std::uint64_t offset) {
  const auto at = static_cast<std::size_t>(channel);
  if (at >= by_channel_.size()) {
    by_channel_.resize(at + 1);
  }
  channel_places& list = by_channel_[at];
  if (list.places.empty()) {
    used_.push_back(channel);
  } else if (log_time_ns < list.places.back().log_time_ns) {
    list.ordered = false;
  }
  list.places.push_back({log_time_ns, offset});
  ++message_count_;
  start_time_ns_ = std::min(start_time_ns_, log_time_ns);
  end_time_ns_ = std::max(end_time_ns_, log_time_ns);
}

void message_index::clear() {
  for (const channel_id channel : used_) {
    channel_places& list = by_channel_[static_cast<std::size_t>(channel)];
    list.places.clear();
    list.ordered = true;
  }
  used_.clear();
  message_count_ = 0;
  start_time_ns_ = UINT64_MAX;
  end_time_ns_ = 0;
}

bool message_index::has(channel_id channel) const { return message_count(channel) > 0; }

std::uint64_t message_index::message_count(channel_id channel) const {
  const auto at = static_cast<std::size_t>(channel);
  return at < by_channel_.size() ? by_channel_[at].places.size() : 0;
}

std::uint64_t message_index::encoded_bytes() const {
  return used_.size() * message_index_header_bytes + message_count_ * message_index_entry_bytes;
}

void message_index::append_records(byte_buffer& out, std::uint64_t file_offset, chunk_index_entry& entry) {
  const std::size_t first = out.size();
  for (const channel_id channel : used_) {
    channel_places& list = by_channel_[static_cast<std::size_t>(channel)];
    if (!list.ordered) {
      std::ranges::stable_sort(list.places, {}, &message_place::log_time_ns);
    }
    entry.index_offsets.emplace(channel, file_offset + (out.size() - first));
    const std::size_t start = begin_record(out, opcode::message_index);
    append_integer(out, static_cast<std::uint16_t>(channel));
    append_integer(out, static_cast<std::uint32_t>(list.places.size() * message_index_entry_bytes));
    std::size_t at = out.size();
    out.resize(at + list.places.size() * message_index_entry_bytes);
    for (const message_place& place : list.places) {
      store(out.data() + at, place.log_time_ns);
      store(out.data() + at + 8, place.offset);
      at += message_index_entry_bytes;
    }
    end_record(out, start);
  }
  entry.index_bytes = out.size() - first;
}

} // namespace godwit::io::mcap
