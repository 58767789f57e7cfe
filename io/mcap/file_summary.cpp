#include "io/mcap/file_summary.hpp"

#include "io/mcap/repair.hpp"

namespace godwit::io::mcap {

namespace {

constexpr std::size_t end_bytes = footer_bytes + magic.size();

void add_record(file_summary& to, opcode op, byte_view content) {
  if (op == opcode::statistics) {
    to.statistics = parse_statistics(content);
  } else if (op == opcode::channel) {
    if (const auto channel = parse_channel(content)) {
      to.channels.push_back({channel->id, std::string{channel->topic}});
    }
  }
}

file_summary parse_summary(byte_view records) {
  file_summary result;
  while (records.size() >= record_prefix_bytes) {
    const auto content_bytes = load<std::uint64_t>(records.data() + 1);
    if (content_bytes > records.size() - record_prefix_bytes) {
      break;
    }
    const opcode op{load<std::uint8_t>(records.data())};
    add_record(result, op, records.subspan(record_prefix_bytes, static_cast<std::size_t>(content_bytes)));
    records = records.subspan(record_prefix_bytes + static_cast<std::size_t>(content_bytes));
  }
  return result;
}

} // namespace

result<std::optional<file_summary>> read_summary(const byte_source& source) {
  const result<bool> is_closed = has_end(source);
  if (!is_closed) {
    return tl::make_unexpected(is_closed.error());
  }
  if (!*is_closed) {
    return std::nullopt;
  }
  byte_buffer bytes(footer_bytes - record_prefix_bytes);
  const std::uint64_t footer_offset = source.size_bytes() - end_bytes;
  if (const auto got = source.read_at(footer_offset + record_prefix_bytes, bytes); !got || *got != bytes.size()) {
    return got ? result<std::optional<file_summary>>{std::nullopt} : tl::make_unexpected(got.error());
  }
  const auto footer = parse_footer(bytes);
  if (!footer || footer->summary_start == 0 || footer_offset - footer->summary_start > file_summary::max_bytes) {
    return std::nullopt;
  }
  bytes.resize(static_cast<std::size_t>(footer_offset - footer->summary_start));
  if (const auto got = source.read_at(footer->summary_start, bytes); !got || *got != bytes.size()) {
    return got ? result<std::optional<file_summary>>{std::nullopt} : tl::make_unexpected(got.error());
  }
  return parse_summary(bytes);
}

} // namespace godwit::io::mcap
