// Signs the frames that leave on one link.
//
// A frame is signed when it is sent and not before, because its timestamp must be above all that went out; a repetition
// is made and signed anew. The frame comes from `encode(..., signing::on)`, so its checksum covers the signed flag.
// `wall_ns` is nanoseconds since 1970, UTC. Errors: `timestamps_used_up`, see signing_clock; the frame is unchanged
// then. Thread: one at a time. Source: the MAVLink guide, "Message Signing".
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"
#include "io/mavlink/signing/signature.hpp"

namespace godwit::io::mavlink {

// Gives out the timestamps of the frames that we sign: each greater than all before it, also those of earlier lives of
// the process.
//
//   life 1   used ........|  reserved on the disk  |          a crash: how much of it was used is not known
//                                                  |
//   life 2                                         |used ...  so the next life begins after all of it
//
// Receivers drop a frame whose timestamp is not above the last one of its stream, so a value that comes twice is a
// frame lost, and a clock that was set back must not take ours along. So a timestamp is the wall clock or one more than
// the last, whichever is greater, and never below the ceiling that an earlier life had reserved. The reservation
// reaches 5 s ahead and no further: what we sign ahead of true time pulls the clock of an autopilot along, which then
// refuses other stations. It is asked for while half of it is left, so that the disk has 2.5 s.
//
// The other end of the link may sign ahead of true time, and refuses what comes long behind it: an ArduPilot puts its
// clock a minute on at each start, and takes no new stream that is a minute behind. So we sign at the newest time that
// it has shown (`follow`), where that is ahead of ours; by which time others are judged does not change with it.
//
// No I/O here. The owner asks `wanted_reservation` now and then (with each frame is cheap enough), writes down what it
// gets, and says `reserved` when that is durable. Until then signing goes on from memory, and `is_beyond_reservation`
// says that a crash now could bring a timestamp twice (if the wall clock is set back too). One reservation is under way
// at a time. A wall clock that is wrong is not recognised here: whoever starts signing waits until it has been set.
// `wall_ns` is nanoseconds since 1970, UTC. Thread: one at a time. Source: the MAVLink guide, "Message Signing", for
// the order of timestamps; the reservation is our own.
class signing_clock {
public:
  static constexpr std::uint64_t reserve_ahead = 5 * signing_units_per_s;
  static constexpr std::uint64_t ask_when_left = reserve_ahead / 2;

  // CEILING is what an earlier life has reserved last: everything below it may have been used. 0 if there was none.
  explicit signing_clock(signing_time ceiling);

  // The timestamp for one frame. None is left in the year 2104, or when a clock has pretended that it is.
  [[nodiscard]] std::optional<signing_time> next(std::int64_t wall_ns);

  // The other end has signed with TIME: from now on we do not sign behind it.
  void follow(signing_time time) { followed_ = std::max(followed_, units(time)); }

  // By how much the other end is ahead of our own time, in units; 0: it is not, or never signed.
  [[nodiscard]] std::uint64_t followed_ahead(std::int64_t wall_ns) const {
    return followed_ - std::min(followed_, units(now(wall_ns)));
  }

  // Our own time, for judging what others sign: whomever we follow. Goes only forward, and gives out nothing.
  [[nodiscard]] signing_time now(std::int64_t wall_ns) const;

  // The ceiling to make durable, if one is wanted and none is under way.
  [[nodiscard]] std::optional<signing_time> wanted_reservation(std::int64_t wall_ns);
  // CEILING is durable.
  void reserved(signing_time ceiling);
  // The one under way did not become durable and will not; the next `wanted_reservation` asks again.
  void reservation_failed() { under_way_ = false; }

  // The last timestamp was given out from memory alone: health is red while this is so.
  [[nodiscard]] bool is_beyond_reservation() const { return free_ > ceiling_; }

private:
  // As integers, because the one after the last timestamp must have a value too.
  [[nodiscard]] std::uint64_t next_free(std::int64_t wall_ns) const;

  std::uint64_t free_;         // the lowest that was not given out
  std::uint64_t own_;          // the same, had nobody been followed
  std::uint64_t ceiling_;      // everything below is reserved
  std::uint64_t followed_ = 0; // the newest time of the other end
  bool under_way_ = false;
};

enum class sign_error { timestamps_used_up };

GODWIT_ENUM_NAMES(sign_error, timestamps_used_up);

class signer {
public:
  // CEILING: what an earlier life has reserved last, see signing_clock.
  signer(secret_key key, link_id link, signing_time ceiling) : hasher_(std::move(key)), link_(link), clock_(ceiling) {}

  // Appends the signature to a frame that waits for it, and gives the timestamp that it carries.
  [[nodiscard]] tl::expected<signing_time, sign_error> sign(frame_buffer& frame, std::int64_t wall_ns);

  [[nodiscard]] signing_clock& clock() { return clock_; }
  [[nodiscard]] link_id link() const { return link_; }

private:
  frame_hasher hasher_;
  link_id link_;
  signing_clock clock_;
};

} // namespace godwit::io::mavlink
