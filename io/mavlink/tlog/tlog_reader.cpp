#include "io/mavlink/tlog/tlog_reader.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "io/mavlink/crc.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/ids.hpp"

namespace godwit::io::mavlink {

namespace {

constexpr std::uint64_t set_clock_from_us = 946'684'800'000'000;    // 2000-01-01
constexpr std::uint64_t set_clock_until_us = 4'481'136'000'000'000; // 2112-01-01
constexpr std::uint64_t day_us = std::uint64_t{24} * 3600 * 1'000'000;

std::uint64_t time_at(byte_view bytes) { return load_tlog_time(bytes.first<tlog_time_size>()); }

bool is_magic(std::byte each) { return each == magic_v2 || each == magic_v1; }

} // namespace

mcap::result<std::optional<tlog_record>> tlog_reader::next() {
  for (;;) {
    if (const auto filled = window_.require(wanted_bytes); !filled)
      return tl::make_unexpected(filled.error());
    const byte_view bytes = window_.bytes();
    if (bytes.size() <= searched_) {
      skip(bytes.size());
      is_searching_ = false;
      return std::nullopt;
    }
    if (auto record = is_searching_ ? search(bytes) : take(bytes))
      return record;
  }
}

std::optional<tlog_record> tlog_reader::take(byte_view bytes) {
  const bool has_frame = bytes.size() > tlog_time_size;
  const looked_at found = has_frame ? look(bytes.subspan(tlog_time_size)) : looked_at{frame_shape::cut_off, 0};
  if (!is_record(bytes, found)) {
    lose(bytes, found);
    return std::nullopt;
  }
  time_us_ = time_at(bytes);
  window_.drop(tlog_time_size);
  return take_found(bytes.subspan(tlog_time_size), found);
}

bool tlog_reader::is_record(byte_view bytes, const looked_at& found) const {
  const std::size_t size = tlog_time_size + found.size;
  if (found.shape == frame_shape::unknown_id)
    return leads_on(bytes.subspan(size)) && !record_begins_in(bytes, tlog_time_size + 1, size);
  return found.is_right() && !is_signature_cut(bytes.subspan(tlog_time_size), found);
}

std::optional<tlog_record> tlog_reader::take_found(byte_view frame, const looked_at& found) {
  const std::uint64_t offset_bytes = window_.offset();
  window_.drop(found.size);
  if (frame.front() == magic_v1) {
    ++counts_.v1_frames;
    return std::nullopt;
  }
  if (found.shape == frame_shape::unknown_flags) {
    ++counts_.unknown_flags;
    return std::nullopt;
  }
  ++(found.is_right() ? counts_.frames : counts_.unknown_ids);
  return tlog_record{time_us_, frame_view(frame.data()), found.is_right(), offset_bytes};
}

void tlog_reader::lose(byte_view bytes, const looked_at& found) {
  const std::size_t end = std::min(tlog_time_size + found.size, bytes.size());
  if (found.shape == frame_shape::nothing || found.shape == frame_shape::unknown_id)
    ++counts_.not_frames;
  else if (found.shape == frame_shape::bad_checksum && !record_begins_in(bytes, tlog_time_size + 1, end))
    ++counts_.bad_checksums;
  else
    ++counts_.cut_off;
  if (is_likely_time(bytes))
    time_us_ = time_at(bytes);
  is_searching_ = true;
  rejected_offset_ = window_.offset() + tlog_time_size;
}

std::optional<tlog_record> tlog_reader::search(byte_view bytes) {
  const std::size_t limit = bytes.size() < wanted_bytes ? bytes.size() : bytes.size() - lookahead_bytes;
  for (std::size_t at = searched_; at < limit; ++at) {
    if (!is_magic(bytes[at]) || window_.offset() + at == rejected_offset_)
      continue;
    const byte_view frame = bytes.subspan(at);
    const looked_at found = look(frame);
    if (!found.is_right() || is_signature_cut(frame, found))
      continue;
    const bool has_time = at >= tlog_time_size && is_likely_time(bytes.subspan(at - tlog_time_size));
    if (!has_time && found.shape == frame_shape::v1)
      continue; // a checksum and one byte of id are too little to tell it from chance
    skip(has_time ? at - tlog_time_size : at);
    is_searching_ = false;
    if (has_time)
      return std::nullopt; // a record like any other
    counts_.without_time += found.shape == frame_shape::v2 ? 1 : 0;
    return take_found(frame, found);
  }
  const std::size_t kept = std::min(limit, tlog_time_size);
  skip(limit - kept);
  searched_ = kept;
  return std::nullopt;
}

void tlog_reader::skip(std::size_t count) {
  counts_.skipped_bytes += count;
  window_.drop(count);
  searched_ = 0;
}

bool tlog_reader::is_likely_time(byte_view bytes) const {
  if (bytes.size() < tlog_time_size)
    return false;
  const std::uint64_t time_us = time_at(bytes);
  const std::uint64_t away_us = std::max(time_us, time_us_) - std::min(time_us, time_us_);
  return (time_us >= set_clock_from_us && time_us < set_clock_until_us) || away_us <= day_us;
}

// FROM and TO are where a record may begin, in BYTES.
bool tlog_reader::record_begins_in(byte_view bytes, std::size_t from, std::size_t to) const {
  for (std::size_t at = from; at < to && at + tlog_time_size < bytes.size(); ++at)
    if (is_magic(bytes[at + tlog_time_size]) && is_likely_time(bytes.subspan(at)) &&
        look(bytes.subspan(at + tlog_time_size)).is_right())
      return true;
  return false;
}

bool tlog_reader::is_signature_cut(byte_view frame, const looked_at& found) const {
  return found.shape == frame_shape::v2 && frame_view(frame.data()).is_signed() &&
         record_begins_in(frame, found.size - signature_size, found.size);
}

// What stands after a frame that can not be verified: another record, or the end, perhaps in the middle of a time.
bool tlog_reader::leads_on(byte_view rest) const {
  return rest.size() <= tlog_time_size || (is_likely_time(rest) && is_magic(rest[tlog_time_size]));
}

namespace {

constexpr std::size_t id_at_v1 = 5;

looked_at look_v1(byte_view bytes) {
  if (bytes.size() < header_size_v1)
    return {frame_shape::cut_off, 0};
  const std::size_t crc_at = header_size_v1 + byte_at(bytes.data(), length_at);
  const std::size_t size = crc_at + crc_size;
  if (bytes.size() < size)
    return {frame_shape::cut_off, size};
  const message_info* const info = find_message(byte_at(bytes.data(), id_at_v1));
  if (info == nullptr)
    return {frame_shape::unknown_id, size};
  const unsigned crc = byte_at(bytes.data(), crc_at) | unsigned{byte_at(bytes.data(), crc_at + 1)} << 8U;
  const bool is_right = frame_crc(bytes.subspan(1, crc_at - 1), info->crc_extra) == crc;
  return {is_right ? frame_shape::v1 : frame_shape::bad_checksum, size};
}

looked_at look_v2(byte_view bytes) {
  if (bytes.size() < header_size)
    return {frame_shape::cut_off, 0};
  const std::size_t size = frame_size(bytes.data());
  if (bytes.size() < size)
    return {frame_shape::cut_off, size};
  const frame_view frame(bytes.data());
  const message_info* const info = find_message(frame.id());
  if (info == nullptr)
    return {frame_shape::unknown_id, size};
  if (!crc_matches(frame, info->crc_extra))
    return {frame_shape::bad_checksum, size};
  return {(frame.incompat() & ~incompat_signed) == 0 ? frame_shape::v2 : frame_shape::unknown_flags, size};
}

} // namespace

looked_at look(byte_view bytes) {
  if (!bytes.empty() && bytes.front() == magic_v2)
    return look_v2(bytes);
  if (!bytes.empty() && bytes.front() == magic_v1)
    return look_v1(bytes);
  return {};
}

mcap::result<void> read_window::require(std::size_t count) {
  assert(count <= window_bytes);
  if (end_ - begin_ >= count)
    return {};
  if (begin_ != 0 && begin_ != end_)
    std::memmove(memory_.data(), memory_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  const auto got = source_->read_at(offset_ + end_, std::span(memory_).subspan(end_));
  if (!got)
    return tl::make_unexpected(got.error());
  end_ += *got;
  return {};
}

void read_window::drop(std::size_t count) {
  assert(count <= end_ - begin_);
  begin_ += count;
  offset_ += count;
}

} // namespace godwit::io::mavlink
