// Reads a .tlog of any size from front to back, also one that holds broken records or is itself broken.
//
//             right frame after the time: given or passed over
//            .--------.
//            v        |     anything else: counted by its cause
//      at a record ---'  ------------------------------------------->  searching
//            ^                                                             |
//            '-------------------------------------------------------------'
//               the next frame whose checksum is right, with its time if there is a likely one in front of it
//
// No right frame is lost by a broken one before it: the search goes byte by byte, begins where the broken record
// begins, and finds frames that stand in the middle of one too (a program that logs what it sends may put several
// frames behind one time). Those are given with the time of the record in which they stand. Two cases take more than a
// checksum:
//
//   unknown id   its checksum can not be verified. It is given, marked as not verified, if its length leads to another
//                record or the end, and no record begins inside.
//   signature    is not covered by the checksum. If a record begins inside it, it was cut off.
//
// A time is likely if it lies in 2000 to 2112, or within a day of the last one (a computer whose clock was never set).
//
// Frames with unknown incompatibility flags and MAVLink 1 frames are counted and passed over. Memory:
// read_window::window_bytes. Errors: io. Thread: one at a time. Source: format.hpp; what real recordings hold.
#pragma once

#include <cstdint>
#include <optional>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/tlog/format.hpp"
#include "io/mavlink/tlog/frame_shape.hpp"
#include "io/mavlink/tlog/read_window.hpp"

namespace godwit::io::mavlink {

struct tlog_record {
  std::uint64_t timestamp_us = 0; // since 1970 UTC, by the clock of whoever wrote it
  frame_view frame;
  bool is_verified = false;       // false: the id is unknown, and so the checksum unchecked
  std::uint64_t offset_bytes = 0; // of the frame in the file
};

struct tlog_counts {
  std::uint64_t frames = 0;       // given, with a right checksum
  std::uint64_t unknown_ids = 0;  // given, not verified
  std::uint64_t without_time = 0; // of `frames`: stood after another record without a time of its own
  std::uint64_t v1_frames = 0;
  std::uint64_t unknown_flags = 0;
  std::uint64_t bad_checksums = 0; // a time and a whole frame, with another checksum
  std::uint64_t cut_off = 0;       // the next record begins, or the file ends, inside the frame
  std::uint64_t not_frames = 0;    // no frame begins there, or one of an unknown id whose length leads nowhere
  std::uint64_t skipped_bytes = 0; // that belong to no record
};

class tlog_reader {
public:
  // The source must outlive the reader.
  explicit tlog_reader(const mcap::byte_source& source) : window_(source) {}

  // The next frame, or none at the end. The view in it is good until the next call.
  [[nodiscard]] mcap::result<std::optional<tlog_record>> next();

  [[nodiscard]] const tlog_counts& counts() const { return counts_; }

private:
  // The longest that a judgement takes: a record, and one more that begins with its last byte.
  static constexpr std::size_t lookahead_bytes = 2 * max_tlog_record_size;
  // With these a search gets on by a byte at least, after the time that it keeps. Fewer: the end of the file is there.
  static constexpr std::size_t wanted_bytes = lookahead_bytes + tlog_time_size + 1;

  // All take the bytes from here on, and drop what they are done with.
  [[nodiscard]] std::optional<tlog_record> take(byte_view bytes);
  [[nodiscard]] std::optional<tlog_record> take_found(byte_view frame, const looked_at& found);
  [[nodiscard]] std::optional<tlog_record> search(byte_view bytes);
  void lose(byte_view bytes, const looked_at& found);
  void skip(std::size_t count);

  [[nodiscard]] bool is_record(byte_view bytes, const looked_at& found) const;
  [[nodiscard]] bool is_likely_time(byte_view bytes) const;
  [[nodiscard]] bool record_begins_in(byte_view bytes, std::size_t from, std::size_t to) const;
  [[nodiscard]] bool is_signature_cut(byte_view frame, const looked_at& found) const;
  [[nodiscard]] bool leads_on(byte_view rest) const;

  read_window window_;
  std::uint64_t time_us_ = 0; // of the last record
  bool is_searching_ = false;
  std::size_t searched_ = 0;          // no frame begins in so many first bytes; they may hold the time of the next one
  std::uint64_t rejected_offset_ = 0; // where a frame should have been and was not
  tlog_counts counts_;
};

} // namespace godwit::io::mavlink
