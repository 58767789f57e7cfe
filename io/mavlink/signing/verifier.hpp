// Judges the frames that arrive on one link: whether each is signed as it must be, and new.
//
//   signed?  no  -> the link's policy for unsigned frames
//            yes -> signature first, and only if it is right the time, with the rules of replay_table
//
// The frame was checked by the scanner. A link without a key is trusted: everything is accepted there, and a signature
// is not looked at. The links that share a key share a replay table, which belongs to their owner and outlives them:
// else a frame that was recorded on one could be sent again on another. Links with another key have another table, as
// the holder of one key must not touch the streams of the other. `now` is our own time: signing_clock::now where we
// sign too, else signing_time_at the wall clock. Thread: one at a time. Source: the MAVLink guide, "Message Signing".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>

#include "io/fields/field_table.hpp"
#include "io/mavlink/signing/link_policy.hpp"
#include "io/mavlink/signing/signature.hpp"

namespace godwit::io::mavlink {

// What became of a frame that arrived, as far as signing goes. Thread: values.
enum class verdict : std::uint8_t {
  accepted_signed,
  accepted_unsigned, // no signature was asked for: the link is trusted, or the id is let through
  bad_signature,     // another key, or changed on the way
  replayed,          // of a known stream, and not above its last timestamp
  too_old,           // of a new stream, and too far behind our time
  too_new,           // too far ahead of our time
  unsigned_refused,
  too_many_streams, // of a new stream, and there is no place for one
};

GODWIT_ENUM_NAMES(verdict, accepted_signed, accepted_unsigned, bad_signature, replayed, too_old, too_new,
                  unsigned_refused, too_many_streams);

[[nodiscard]] constexpr bool is_accepted(verdict each) {
  return each == verdict::accepted_signed || each == verdict::accepted_unsigned;
}

// How many frames got which verdict.
class verdict_counts {
public:
  void count(verdict each) { ++counts_[static_cast<std::size_t>(each)]; }
  [[nodiscard]] std::uint64_t of(verdict each) const { return counts_[static_cast<std::size_t>(each)]; }
  [[nodiscard]] std::uint64_t total() const {
    return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
  }
  [[nodiscard]] std::uint64_t rejected() const {
    return total() - of(verdict::accepted_signed) - of(verdict::accepted_unsigned);
  }

private:
  std::array<std::uint64_t, enum_names(verdict{}).size()> counts_{};
};

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

class verifier {
public:
  // A trusted link.
  verifier() : policy_(unsigned_policy::accept_all()) {}
  // A link whose frames are signed with KEY.
  verifier(secret_key key, replay_table& streams, const unsigned_policy& policy = unsigned_policy())
      : hasher_(std::in_place, std::move(key)), streams_(&streams), policy_(policy) {}

  [[nodiscard]] verdict judge(const frame_view& frame, signing_time now);

  [[nodiscard]] bool has_key() const { return hasher_.has_value(); }
  [[nodiscard]] const verdict_counts& counts() const { return counts_; }

private:
  [[nodiscard]] verdict judge_uncounted(const frame_view& frame, signing_time now);

  std::optional<frame_hasher> hasher_;
  replay_table* streams_ = nullptr; // there is one if there is a key
  unsigned_policy policy_;
  verdict_counts counts_;
};

} // namespace godwit::io::mavlink
