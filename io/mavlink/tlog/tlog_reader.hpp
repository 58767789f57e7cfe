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
// frames after one time). Those are given with the time of the record in which they stand. Two cases take more than a
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

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/wire_format.hpp"
#include "io/mcap/byte_source.hpp"

namespace godwit::io::mavlink {

// What stands at a place in a log where a frame may begin, judged from the bytes alone.
//
// Thread: pure. Source: the MAVLink guide, "Packet Serialization".
enum class frame_shape : std::uint8_t {
  nothing,       // neither FD nor FE
  cut_off,       // it goes on after the end of the bytes
  unknown_id,    // whole by its length; its checksum can not be verified
  bad_checksum,  // whole by its length
  unknown_flags, // right, with an incompatibility flag that we do not know
  v1,            // right, MAVLink 1
  v2,            // right
};

struct looked_at {
  frame_shape shape = frame_shape::nothing;
  std::size_t size = 0; // of the whole frame, as far as it is known
  // The checksum says that a frame of this size is here.
  [[nodiscard]] bool is_right() const { return shape >= frame_shape::unknown_flags; }
};

// What begins with the first of BYTES, which may reach further than one frame.
[[nodiscard]] looked_at look(byte_view bytes);

// A part of a file in memory that moves towards its end, so that a file of any size is read with the same memory.
//
// Errors: those of the source. Thread: one at a time.
class read_window {
public:
  static constexpr std::size_t window_bytes = std::size_t{64} << 10;

  // The source must outlive the window.
  explicit read_window(const mcap::byte_source& source) : source_(&source), memory_(window_bytes) {}

  // Reads on until at least COUNT bytes, at most `window_bytes`, are there, or all up to the end of the source. Moves
  // what `bytes` gave before.
  [[nodiscard]] mcap::result<void> require(std::size_t count);

  [[nodiscard]] byte_view bytes() const { return {memory_.data() + begin_, end_ - begin_}; }
  // Where in the source `bytes` begins.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }

  // The first COUNT of `bytes` are done with. They stay where they are until the next `require`.
  void drop(std::size_t count);

private:
  const mcap::byte_source* source_;
  std::vector<std::byte> memory_;
  std::size_t begin_ = 0; // of what was not dropped, in memory_
  std::size_t end_ = 0;
  std::uint64_t offset_ = 0;
};

// The .tlog format of ground stations: one record after the other, without a header.
//
//   time[8] frame     time: microseconds since 1970 UTC, big-endian (alone so in all of MAVLink); frame: as on the wire
//
// Source: what QGroundControl, MAVProxy and pymavlink write and read. Thread: pure.
inline constexpr std::size_t tlog_time_size = 8;
inline constexpr std::size_t max_tlog_record_size = tlog_time_size + max_frame_size;

[[nodiscard]] constexpr std::uint64_t load_tlog_time(std::span<const std::byte, tlog_time_size> bytes) {
  std::uint64_t time_us = 0;
  for (const std::byte each : bytes)
    time_us = time_us << 8U | std::to_integer<std::uint64_t>(each);
  return time_us;
}

constexpr void store_tlog_time(std::span<std::byte, tlog_time_size> to, std::uint64_t time_us) {
  for (std::size_t i = to.size(); i-- > 0; time_us >>= 8U)
    to[i] = static_cast<std::byte>(time_us);
}

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
