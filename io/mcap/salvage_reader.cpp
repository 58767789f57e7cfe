#include "io/mcap/salvage_reader.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

namespace {

constexpr std::size_t search_block_bytes = std::size_t{256} << 10;
constexpr std::uint8_t first_private_opcode = 0x80;
constexpr std::size_t index_fields_bytes = message_index_header_bytes - record_prefix_bytes;

bool is_known(std::uint8_t op) {
  return (op >= static_cast<std::uint8_t>(opcode::header) && op <= static_cast<std::uint8_t>(opcode::data_end)) ||
         op >= first_private_opcode;
}

std::string fields_do_not_fit(opcode op) {
  return "the fields of a record (opcode " + std::to_string(static_cast<int>(op)) + ") do not fit";
}

} // namespace

result<salvage_reader::item> salvage_reader::next() {
  while (!is_done_ || !chunk_.empty()) {
    step s = !chunk_.empty() ? step_in_chunk() : has_started_ ? step_record() : step_start();
    if (!s) {
      is_done_ = true;
      return tl::make_unexpected(s.error());
    }
    if (*s) {
      return std::move(**s);
    }
  }
  return item{end_of_file{size_bytes_}};
}

unreadable salvage_reader::lost(std::uint64_t offset, std::uint64_t bytes, std::string why) const {
  return {offset, bytes, false, !is_after_data_, std::move(why)};
}

// Bytes of the file, fewer than asked for only at its end. Valid until the next call.
result<byte_view> salvage_reader::view(std::uint64_t offset, std::uint64_t bytes) {
  const auto wanted = static_cast<std::size_t>(std::min(bytes, size_bytes_ - std::min(offset, size_bytes_)));
  if (wanted == 0) {
    return byte_view{};
  }
  const bool is_there = offset >= window_offset_ && offset + wanted <= window_offset_ + window_bytes_;
  if (!is_there) {
    const auto left = static_cast<std::size_t>(std::min<std::uint64_t>(size_bytes_ - offset, read_ahead_bytes));
    const std::size_t target = std::max(wanted, left);
    if (window_.size() < target) {
      window_.resize(target);
    }
    window_offset_ = offset;
    window_bytes_ = 0;
    while (window_bytes_ < target) {
      const auto got = source_.read_at(offset + window_bytes_, std::span{window_}.subspan(window_bytes_));
      if (!got) {
        return tl::make_unexpected(got.error());
      }
      if (*got == 0) {
        break;
      }
      window_bytes_ += *got;
    }
  }
  const auto at = static_cast<std::size_t>(offset - window_offset_);
  return byte_view{window_}.subspan(at, std::min(wanted, window_bytes_ - std::min(at, window_bytes_)));
}

salvage_reader::step salvage_reader::step_start() {
  has_started_ = true;
  const auto begin = view(0, magic.size());
  if (!begin) {
    return tl::make_unexpected(begin.error());
  }
  if (std::ranges::equal(*begin, magic)) {
    offset_ = magic.size();
    return std::nullopt;
  }
  if (begin->size() < magic.size() && std::ranges::equal(*begin, byte_view{magic}.first(begin->size()))) {
    is_done_ = true;
    auto cut = lost(0, size_bytes_, "it ends within its first bytes");
    cut.is_cut = true;
    return item{std::move(cut)};
  }
  return lose_from(0, "it does not begin as an MCAP file does");
}

salvage_reader::step salvage_reader::step_record() {
  const std::uint64_t left = size_bytes_ - offset_;
  const auto prefix = view(offset_, record_prefix_bytes);
  if (!prefix) {
    return tl::make_unexpected(prefix.error());
  }
  if (left == 0 || prefix->size() < record_prefix_bytes) {
    is_done_ = true;
    auto cut = lost(offset_, left, left == 0 ? "the end is missing" : "the end is missing, the last record is torn");
    cut.is_cut = true;
    cut.may_hold_messages = !is_after_data_ && left != 0;
    return item{std::move(cut)};
  }
  const auto op = load<std::uint8_t>(prefix->data());
  const auto content_bytes = load<std::uint64_t>(prefix->data() + 1);
  if (content_bytes > limits_.record_bytes || content_bytes > left - record_prefix_bytes) {
    return lose_from(offset_, is_known(op) ? "a record of " + std::to_string(content_bytes) + " bytes does not fit"
                                           : std::string("no record begins here"));
  }
  const std::uint64_t whole_bytes = record_prefix_bytes + content_bytes;
  const auto is_chunk = is_chunk_by_another_name(opcode{op}, whole_bytes);
  if (!is_chunk) {
    return tl::make_unexpected(is_chunk.error());
  }
  const auto whole = view(offset_, whole_bytes);
  if (!whole) {
    return tl::make_unexpected(whole.error());
  }
  if (whole->size() < whole_bytes) {
    return lose_from(offset_, "the file has become shorter");
  }
  next_offset_ = offset_ + whole_bytes;
  if (!is_known(op) && !*is_chunk) { // of a later version of the format, or no record at all
    return op == 0 ? lose_from(offset_, "no record begins here") : lose_record("no record that is known begins here");
  }
  return on_record(*is_chunk ? opcode::chunk : opcode{op}, whole->subspan(record_prefix_bytes));
}

// A chunk whose first byte is damaged would be skipped, or taken for something else, without a word.
result<bool> salvage_reader::is_chunk_by_another_name(opcode op, std::uint64_t whole_bytes) {
  if (op == opcode::chunk || is_after_data_ || whole_bytes < chunk_header_bytes) {
    return false;
  }
  const auto head = view(offset_, chunk_header_bytes);
  if (!head) {
    return tl::make_unexpected(head.error());
  }
  if (head->size() < chunk_header_bytes) {
    return false;
  }
  std::array<std::byte, chunk_header_bytes> copy; // the next look into the file moves the window
  std::ranges::copy(*head, copy.begin());
  return is_sound_chunk(offset_, copy);
}

salvage_reader::step salvage_reader::on_record(opcode op, byte_view content) {
  const auto tell = [&](auto record) -> step {
    if (!record) {
      return lose_record(fields_do_not_fit(op));
    }
    offset_ = next_offset_;
    return item{std::move(*record)};
  };
  switch (op) {
  case opcode::schema:
  case opcode::channel:
    if (is_after_data_) { // copies, which no CRC of a chunk covers: read_summary checks and reads them
      break;
    }
    return op == opcode::schema ? tell(parse_schema(content)) : tell(parse_channel(content));
  case opcode::message:
    return is_after_data_ ? lose_record("there is a message after the end of the data") : tell(parse_message(content));
  case opcode::metadata:
    return tell(parse_metadata(content));
  case opcode::chunk:
    return on_chunk(content);
  case opcode::message_index:
    return on_message_index(content);
  case opcode::data_end:
    is_after_data_ = true;
    break;
  case opcode::footer:
    return on_end_mark();
  default:
    break;
  }
  offset_ = next_offset_;
  return std::nullopt;
}

// Its length is said twice; a wrong one would hide what stands after it. Where a record stands after both, the one
// that the format goes by counts.
salvage_reader::step salvage_reader::on_message_index(byte_view content) {
  constexpr std::string_view why = "an index has two different sizes";
  if (content.size() < index_fields_bytes) {
    return lose_record(std::string(why));
  }
  const auto said_bytes = load<std::uint32_t>(content.data() + 2);
  if (said_bytes == content.size() - index_fields_bytes) {
    offset_ = next_offset_;
    return std::nullopt;
  }
  const auto as_said = offset_ + message_index_header_bytes + said_bytes;
  const auto stands = stands_record_at(next_offset_);
  const auto stands_as_said = as_said < next_offset_ ? stands_record_at(as_said) : result<bool>{false};
  if (!stands || !stands_as_said) {
    return tl::make_unexpected(!stands ? stands.error() : stands_as_said.error());
  }
  if (!*stands && *stands_as_said) {
    next_offset_ = as_said;
  }
  return lose_record(std::string(why));
}

salvage_reader::step salvage_reader::on_chunk(byte_view content) {
  const auto chunk = parse_chunk(content);
  if (!chunk) {
    return lose_record(fields_do_not_fit(opcode::chunk));
  }
  if (!chunk->compression.empty() && chunk->compression != zstd_name) {
    return lose_record("a chunk is compressed (" + std::string{chunk->compression.substr(0, 32)} +
                       "), which is not read");
  }
  const auto records = records_of(*chunk);
  if (!records) {
    return lose_record("a chunk can not be decompressed");
  }
  if (chunk->uncompressed_bytes != records->size()) {
    return lose_record("a chunk has two different sizes");
  }
  if (chunk->crc != 0 && crc_of(*records) != chunk->crc) {
    return lose_record("the checksum of a chunk is wrong");
  }
  chunk_ = *records;
  is_compressed_ = !chunk->compression.empty();
  chunk_offset_ = offset_;
  offset_ = next_offset_;
  return std::nullopt;
}

// As they were written. Nothing: they can not be decompressed.
std::optional<byte_view> salvage_reader::records_of(const chunk_record& chunk) {
  if (chunk.compression.empty()) {
    return chunk.records;
  }
  if (chunk.uncompressed_bytes > limits_.record_bytes ||
      !unpack_.decompress(chunk.records, chunk.uncompressed_bytes, unpacked_)) {
    return std::nullopt;
  }
  return byte_view{unpacked_};
}

salvage_reader::step salvage_reader::step_in_chunk() {
  const auto give_up = [this](std::string why) -> step {
    const auto rest = std::exchange(chunk_, {}).size();
    const auto bytes = is_compressed_ ? next_offset_ - chunk_offset_ : rest; // where in it is not known
    return item{lost(next_offset_ - bytes, bytes, std::move(why))};
  };
  if (chunk_.size() < record_prefix_bytes ||
      load<std::uint64_t>(chunk_.data() + 1) > chunk_.size() - record_prefix_bytes) {
    return give_up("a record is longer than its chunk");
  }
  const opcode op{load<std::uint8_t>(chunk_.data())};
  const auto content_bytes = static_cast<std::size_t>(load<std::uint64_t>(chunk_.data() + 1));
  const byte_view content = chunk_.subspan(record_prefix_bytes, content_bytes);
  const auto tell = [&](auto record) -> step {
    if (!record) {
      return give_up(fields_do_not_fit(op));
    }
    chunk_ = chunk_.subspan(record_prefix_bytes + content_bytes);
    return item{std::move(*record)};
  };
  switch (op) {
  case opcode::schema:
    return tell(parse_schema(content));
  case opcode::channel:
    return tell(parse_channel(content));
  case opcode::message:
    return tell(parse_message(content));
  default:
    chunk_ = chunk_.subspan(record_prefix_bytes + content_bytes);
    return std::nullopt;
  }
}

salvage_reader::step salvage_reader::on_end_mark() {
  const auto mark = view(next_offset_, magic.size());
  if (!mark) {
    return tl::make_unexpected(mark.error());
  }
  if (!std::ranges::equal(*mark, magic)) {
    return lose_record("the end mark is not the one of MCAP");
  }
  offset_ = next_offset_ + magic.size();
  is_done_ = offset_ == size_bytes_;
  if (is_done_) {
    return std::nullopt;
  }
  is_after_data_ = false; // whatever stands there
  return lose_from(offset_, "there is more after the end");
}

// Everything up to the next chunk whose CRC holds, or to the end.
salvage_reader::step salvage_reader::lose_from(std::uint64_t offset, std::string why) {
  const auto found = find_chunk(offset + 1);
  if (!found) {
    return tl::make_unexpected(found.error());
  }
  auto result = lost(offset, found->value_or(size_bytes_) - offset, std::move(why));
  result.is_cut = !*found && !is_after_data_;
  offset_ = found->value_or(size_bytes_);
  is_done_ = !*found;
  return item{std::move(result)};
}

// One record, if another one stands after it; else its length may be what is wrong.
salvage_reader::step salvage_reader::lose_record(std::string why) {
  const auto stands = stands_record_at(next_offset_);
  if (!stands) {
    return tl::make_unexpected(stands.error());
  }
  if (!*stands) {
    return lose_from(offset_, std::move(why));
  }
  auto result = lost(offset_, next_offset_ - offset_, std::move(why));
  offset_ = next_offset_;
  return item{std::move(result)};
}

result<bool> salvage_reader::stands_record_at(std::uint64_t offset) {
  const auto prefix = view(offset, record_prefix_bytes);
  if (!prefix) {
    return tl::make_unexpected(prefix.error());
  }
  if (prefix->size() < record_prefix_bytes) {
    return false;
  }
  const auto content_bytes = load<std::uint64_t>(prefix->data() + 1);
  return is_known(load<std::uint8_t>(prefix->data())) && content_bytes <= limits_.record_bytes &&
         content_bytes <= size_bytes_ - offset - record_prefix_bytes;
}

result<std::optional<std::uint64_t>> salvage_reader::find_chunk(std::uint64_t from) {
  byte_buffer block(search_block_bytes);
  while (from + chunk_header_bytes <= size_bytes_) {
    const auto got = source_.read_at(from, block);
    if (!got) {
      return tl::make_unexpected(got.error());
    }
    if (*got < chunk_header_bytes) {
      break;
    }
    const byte_view bytes = byte_view{block}.first(*got);
    const std::size_t starts = bytes.size() - chunk_header_bytes + 1;
    for (std::size_t at = 0; at < starts; ++at) {
      const void* const next = std::memchr(bytes.data() + at, static_cast<int>(opcode::chunk), starts - at);
      if (next == nullptr) {
        break;
      }
      at = static_cast<std::size_t>(static_cast<const std::byte*>(next) - bytes.data());
      const auto sound = is_sound_chunk(from + at, bytes.subspan(at, chunk_header_bytes));
      if (!sound) {
        return tl::make_unexpected(sound.error());
      }
      if (*sound) {
        return from + at;
      }
    }
    from += starts;
  }
  return std::nullopt;
}

// HEAD: as many bytes of it as a chunk that is not compressed has before its records.
result<bool> salvage_reader::is_sound_chunk(std::uint64_t offset, byte_view head) {
  const std::byte* at = head.data();
  const auto content_bytes = load<std::uint64_t>(at + 1);
  const auto uncompressed_bytes = load<std::uint64_t>(at + record_prefix_bytes + 16);
  const auto crc = load<std::uint32_t>(at + record_prefix_bytes + 24);
  const auto compression_bytes = load<std::uint32_t>(at + record_prefix_bytes + 28);
  constexpr std::size_t fields_bytes = chunk_header_bytes - record_prefix_bytes;
  const bool is_compressed =
      compression_bytes == zstd_name.size() &&
      std::ranges::equal(head.subspan(record_prefix_bytes + 32, zstd_name.size()), bytes_of(zstd_name));
  const bool has_one_size =
      is_compressed || (compression_bytes == 0 && content_bytes == fields_bytes + uncompressed_bytes);
  if (!has_one_size || crc == 0 || content_bytes > limits_.record_bytes || uncompressed_bytes > limits_.record_bytes ||
      content_bytes > size_bytes_ - offset - record_prefix_bytes) {
    return false;
  }
  if (searched_bytes_ + std::max(content_bytes, uncompressed_bytes) > search_factor * size_bytes_) {
    return false;
  }
  searched_bytes_ += std::max(content_bytes, uncompressed_bytes);
  return view(offset + record_prefix_bytes, content_bytes).map([&](byte_view content) {
    const auto chunk = content.size() == content_bytes ? parse_chunk(content) : std::nullopt;
    const auto records = chunk ? records_of(*chunk) : std::nullopt;
    return records && records->size() == uncompressed_bytes && crc_of(*records) == crc;
  });
}

} // namespace godwit::io::mcap
