#include "io/mcap/message_index.hpp"

#include <algorithm>

namespace godwit::io::mcap {

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
