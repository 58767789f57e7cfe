#include "io/mcap/record_reader.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

namespace {

constexpr std::size_t read_ahead_bytes = std::size_t{64} << 10; // so that small records do not cost a read each
constexpr std::size_t growth_step_bytes = std::size_t{1} << 20; // trust a length only as far as bytes arrive

bool is_zero(std::byte b) { return b == std::byte{0}; }

} // namespace

error record_reader::failure(errc code, std::uint64_t offset, std::string what) const {
  return {code, source_.name(), std::move(what), offset};
}

void record_reader::consume() {
  if (!std::exchange(crc_skips_current_, false)) {
    crc_ = crc_of(available().first(current_bytes_), crc_);
  }
  begin_ += current_bytes_;
  offset_ += current_bytes_;
  current_bytes_ = 0;
}

void record_reader::restart_crc() {
  crc_ = 0;
  crc_skips_current_ = true;
}

result<bool> record_reader::ensure(std::size_t bytes) {
  if (available().size() >= bytes) {
    return true;
  }
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  const std::size_t target = std::max(bytes, read_ahead_bytes);
  while (buffer_.size() < target) {
    const std::size_t have = buffer_.size();
    buffer_.resize(std::min(have + growth_step_bytes, target));
    const result<std::size_t> got = source_.read_at(offset_ + have, std::span{buffer_}.subspan(have));
    buffer_.resize(have + got.value_or(0));
    if (!got) {
      return tl::make_unexpected(got.error());
    }
    if (*got == 0) {
      break;
    }
  }
  return buffer_.size() >= bytes;
}

result<bool> record_reader::only_zeros_left() const {
  if (!std::ranges::all_of(available(), is_zero)) {
    return false;
  }
  std::array<std::byte, 4096> block;
  for (std::uint64_t at = offset_ + available().size();;) {
    const result<std::size_t> got = source_.read_at(at, block);
    if (!got) {
      return tl::make_unexpected(got.error());
    }
    if (*got == 0 || !std::all_of(block.begin(), block.begin() + *got, is_zero)) {
      return *got == 0;
    }
    at += *got;
  }
}

result<record_reader::magic_outcome> record_reader::read_magic() {
  consume();
  const result<bool> enough = ensure(magic.size());
  if (!enough) {
    return tl::make_unexpected(enough.error());
  }
  const byte_view found = available().first(std::min(available().size(), magic.size()));
  if (!std::ranges::equal(found, byte_view{magic}.first(found.size()))) {
    return tl::make_unexpected(failure(errc::malformed, offset_, "no MCAP magic"));
  }
  if (!*enough) {
    return truncated_here();
  }
  current_bytes_ = magic.size();
  return std::monostate{};
}

result<record_reader::outcome> record_reader::next() {
  consume();
  const result<bool> prefix = ensure(record_prefix_bytes);
  if (!prefix) {
    return tl::make_unexpected(prefix.error());
  }
  if (!*prefix) {
    return truncated_here();
  }
  const auto op = load<std::uint8_t>(available().data());
  if (op == 0) {
    return only_zeros_left().and_then([this](bool zeros) -> result<outcome> {
      if (zeros) {
        return truncated_here();
      }
      return tl::make_unexpected(failure(errc::malformed, offset_, "opcode 0"));
    });
  }
  const auto content_bytes = load<std::uint64_t>(available().data() + 1);
  if (content_bytes > limits_.record_bytes) {
    return tl::make_unexpected(failure(errc::malformed, offset_,
                                       "record of " + std::to_string(content_bytes) + " bytes, the limit is " +
                                           std::to_string(limits_.record_bytes)));
  }
  const std::size_t whole_bytes = record_prefix_bytes + static_cast<std::size_t>(content_bytes);
  const result<bool> enough = ensure(whole_bytes);
  if (!enough) {
    return tl::make_unexpected(enough.error());
  }
  if (!*enough) {
    return truncated_here();
  }
  current_bytes_ = whole_bytes;
  return raw_record{opcode{op}, offset_, available().first(whole_bytes)};
}

result<bool> record_reader::at_end() {
  consume();
  return ensure(1).map([](bool more) { return !more; });
}

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
