#include "io/mcap/repair.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "io/mcap/crc.hpp"
#include "io/mcap/output_file.hpp"
#include "io/mcap/records.hpp"
#include "io/mcap/scan.hpp"

namespace godwit::io::mcap {

namespace {

result<std::uint32_t> crc_between(const byte_source& source, std::uint64_t begin, std::uint64_t end) {
  byte_buffer block(std::size_t{64} << 10);
  std::uint32_t crc = 0;
  while (begin < end) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), end - begin));
    const result<std::size_t> got = source.read_at(begin, std::span{block}.first(wanted));
    if (!got) {
      return tl::make_unexpected(got.error());
    }
    if (*got == 0) {
      break; // the file has shrunk meanwhile; the CRC will not match
    }
    crc = crc_of(byte_view{block}.first(*got), crc);
    begin += *got;
  }
  return crc;
}

} // namespace

result<bool> has_end(const byte_source& source) {
  constexpr std::size_t end_bytes = footer_bytes + magic.size();
  const std::uint64_t size_bytes = source.size_bytes();
  if (size_bytes < magic.size() + end_bytes) {
    return false;
  }
  std::array<std::byte, end_bytes> end;
  const std::uint64_t footer_offset = size_bytes - end_bytes;
  if (const auto got = source.read_at(footer_offset, end); !got || *got != end_bytes) {
    return got ? result<bool>{false} : tl::make_unexpected(got.error());
  }
  const byte_view bytes{end};
  const bool is_footer = bytes[0] == static_cast<std::byte>(opcode::footer) &&
                         load<std::uint64_t>(bytes.data() + 1) == footer_bytes - record_prefix_bytes;
  if (!is_footer || !std::ranges::equal(bytes.last(magic.size()), magic)) {
    return false;
  }
  const auto footer = parse_footer(bytes.subspan(record_prefix_bytes, footer_bytes - record_prefix_bytes));
  if (!footer || footer->summary_start > footer_offset) {
    return false;
  }
  if (footer->summary_crc == 0) {
    return true;
  }
  const std::uint64_t begin = footer->summary_start == 0 ? footer_offset : footer->summary_start;
  const std::uint64_t crc_offset = footer_offset + footer_bytes - sizeof(std::uint32_t);
  return crc_between(source, begin, crc_offset).map([&](std::uint32_t crc) { return crc == footer->summary_crc; });
}

result<completion> complete(const std::filesystem::path& path, read_limits limits) {
  file_source source;
  if (auto opened = source.open(path); !opened) {
    return tl::make_unexpected(opened.error());
  }
  const result<bool> whole = has_end(source);
  if (!whole) {
    return tl::make_unexpected(whole.error());
  }
  if (*whole) {
    return completion{.was_complete = true};
  }
  const result<completion_plan> plan = plan_completion(source, limits);
  if (!plan) {
    return tl::make_unexpected(plan.error());
  }
  output_file file;
  return file.open_and_cut(path, plan->keep_bytes)
      .and_then([&] { return file.append(plan->tail); })
      .and_then([&] { return file.close(); })
      .map([&] {
        return completion{false, plan->messages, source.size_bytes() - plan->keep_bytes, plan->tail.size()};
      });
}

} // namespace godwit::io::mcap
