// The last timestamp of each stream of signed frames, against frames that were recorded and are sent again.
//
// A stream is a sender and the id of its link. Only frames whose signature was found right come here, so whoever fills
// the table has the key. The rules, in their order:
//
//   stream is   timestamp is                                            verdict
//   any         more than 10 min ahead of our time                      too_new
//   known       not above the last one of the stream                    replayed
//   new         more than 60 s behind our time                          too_old
//   new         not above the last one of a stream that was forgotten   replayed
//   new         anything else, and all 16 places are in use             too_many_streams
//
// ArduPilot signs about a minute ahead of true time, and puts its clock a minute on at each start: some starts in a row
// must not make us deaf, hence 10 min. A place is freed only when the last timestamp in it
// is more than 60 s behind our time: the frames of that stream are then too old to come in as those of a new one, so
// forgetting it opens no door; the stream itself comes back with its next frame. The last rule but one holds the door
// also when our clock is set back after that. What arrives never moves the time by which others are judged: one frame
// from the future, of a station whose clock is wrong, would have us refuse all others.
//
// Kept in memory alone: after a start a frame may come again that is no more than 60 s older than the newest time that
// we have signed with ourselves, which is the vehicle's (signing_clock.hpp). Thread: one at a time. Source:
// the MAVLink guide, "Message Signing", and its C library, which has 16 places and does not free them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "io/mavlink/signing/signature.hpp"
#include "io/mavlink/signing/verdict.hpp"

namespace godwit::io::mavlink {

inline constexpr std::size_t max_signed_streams = 16;
inline constexpr std::uint64_t max_behind = 60 * signing_units_per_s;
inline constexpr std::uint64_t max_ahead = 600 * signing_units_per_s;

struct signed_stream {
  sender from;
  link_id link{};
  friend constexpr bool operator==(const signed_stream&, const signed_stream&) = default;
};

class replay_table {
public:
  // TIME came with a right signature; NOW is our own time. accepted_signed remembers it, every other verdict leaves the
  // table as it was.
  [[nodiscard]] verdict take(const signed_stream& stream, signing_time time, signing_time now);

  [[nodiscard]] std::size_t streams() const { return count_; }
  [[nodiscard]] std::uint64_t streams_forgotten() const { return forgotten_; }

private:
  struct place {
    signed_stream stream;
    signing_time last{};
  };

  [[nodiscard]] verdict take_new(const signed_stream& stream, signing_time time, signing_time now);
  // The place with the oldest timestamp if it may be forgotten, else null.
  [[nodiscard]] place* freed_place(signing_time now);

  std::array<place, max_signed_streams> places_{};
  std::size_t count_ = 0;
  std::uint64_t forgotten_ = 0;
  signing_time last_forgotten_{}; // the highest timestamp of all streams that were forgotten
};

} // namespace godwit::io::mavlink
