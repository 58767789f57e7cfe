// What must hold for any bytes that a reader of .tlog is given; the fuzzer tries bytes, and a test plants defects to
// show that they are found.
//
// An input is one byte and a log; the lowest bit of the byte says whether checksums are made right first. Then:
//
//   - the reader ends, and its records lie in the log one after the other, with the time that stands before them;
//   - a record that is called verified has a right checksum, and one that is not has an id that nobody knows;
//   - every right frame that a search from byte to byte finds is given, or lies in a record that is;
//   - the bytes that it calls skipped and those that it gave are not more than there are.
//
// The reader is passed in as a type. Thread: pure.
#pragma once

#include <vector>

#include "io/mavlink/tlog/tlog_reader.hpp"
#include "tests/fuzz/scan_harness.hpp"

namespace godwit::io::mavlink::fuzz {

struct place {
  std::uint64_t begin = 0; // of the time before a frame, as far as there is one
  std::uint64_t end = 0;
};

inline finding check_record(byte_view log, const tlog_record& record, std::uint64_t after_last, bool has_time) {
  const std::size_t size = record.frame.size();
  if (record.offset_bytes < after_last || record.offset_bytes + size > log.size())
    return "a record is not where it can be";
  const byte_view before = log.first(record.offset_bytes);
  if (!std::ranges::equal(record.frame.bytes(), log.subspan(record.offset_bytes, size)))
    return "a frame is not what is in the log";
  const auto* const info = find_message(record.frame.id());
  if (record.is_verified != (info != nullptr))
    return "verified, or not, against the table of ids";
  if (info != nullptr && !crc_matches(record.frame, info->crc_extra))
    return "a frame with a wrong checksum";
  if (!has_time)
    return std::nullopt;
  if (before.size() < tlog_time_size || record.timestamp_us != load_tlog_time(before.last<tlog_time_size>()))
    return "a time that is not the one before the frame";
  return std::nullopt;
}

// PLACES in their order. Frames of MAVLink 1 and with unknown flags must not have been passed over.
inline finding check_nothing_lost(byte_view log, const std::vector<place>& places) {
  auto next = places.begin();
  for (std::size_t at = 0; at + min_frame_size <= log.size(); ++at) {
    while (next != places.end() && at >= next->end)
      ++next;
    if (next != places.end() && at >= next->begin)
      continue;
    // A signed frame may be refused for a record that begins in its signature.
    if (log[at] != magic_v2 || log[at + incompat_at] != std::byte{0} || at + frame_size(log.data() + at) > log.size())
      continue;
    const frame_view frame(log.data() + at);
    const auto* const info = find_message(frame.id());
    if (info != nullptr && crc_matches(frame, info->crc_extra))
      return "a right frame was lost";
  }
  return std::nullopt;
}

template <class Reader = tlog_reader>
finding check_tlog(byte_view input) {
  if (input.empty())
    return std::nullopt;
  byte_buffer log(input.begin() + 1, input.end());
  if ((byte_at(input.data(), 0) & 1U) == 0)
    repair(log);

  const mcap::memory_source source(log);
  Reader reader(source);
  std::vector<place> places;
  std::uint64_t bytes_given = 0;
  std::uint64_t without_time = 0;
  for (;;) {
    const auto record = reader.next();
    if (!record)
      return "an error from memory: " + record.error().message();
    if (!*record)
      break;
    const bool has_time = reader.counts().without_time == without_time;
    without_time = reader.counts().without_time;
    if (auto found = check_record(log, **record, places.empty() ? 0 : places.back().end, has_time))
      return found;
    const std::uint64_t begin = (*record)->offset_bytes - (has_time ? tlog_time_size : 0);
    places.push_back({begin, (*record)->offset_bytes + (*record)->frame.size()});
    bytes_given += places.back().end - begin;
  }
  const tlog_counts& counts = reader.counts();
  if (counts.frames + counts.unknown_ids != places.size())
    return "other counts than records";
  if (counts.skipped_bytes + bytes_given > log.size())
    return "more bytes than there are";
  if (counts.v1_frames != 0 || counts.unknown_flags != 0)
    return std::nullopt;
  if (counts.skipped_bytes + bytes_given != log.size())
    return "bytes that are neither given nor skipped";
  return check_nothing_lost(log, places);
}

} // namespace godwit::io::mavlink::fuzz
