// Finds the frames in a stream of bytes that comes in pieces of any size.
//
//   scanner.feed(bytes, [](const frame_view& frame) { ... });   // a piece of a stream
//   scanner.feed_datagram(bytes, sink);                         // a whole datagram
//   scanner.feed_next_datagram(bytes, sink);                    // of one sender, who may split frames over datagrams
//
// Strict: a frame reaches the sink only if its id is in io/mavlink/ids.hpp, its checksum is right and it has no unknown
// incompatibility flag. After anything else the search goes on with the byte after the false FD, so that a false start
// costs no real frame that lies in the bytes which it claimed:
//
//   FD, id known, checksum right    a frame; with an unknown flag passed over as a whole
//   FD, id known, checksum wrong    on from the next byte
//   FD, id and a flag unknown       on from the next byte
//   FD, id unknown                  passed over if no good frame lies in it, and if the datagram ends after it or what
//                                   follows is the header of a sender that was heard before; else on from the next byte
//   FE (MAVLink 1)                  passed over if id, length and checksum fit, else on from the next byte
//   anything else                   garbage
//
// What lies whole in the given bytes is handed on where it is; at most one frame and the header of the next wait for
// more. A stream, and a sender of datagrams, should be told of a long silence (`end_of_datagram`): else a false start
// that claims 280 bytes holds back what comes after it until so much has come. What garbage costs is bounded: one
// checksum of at most 264 bytes for each FD that has a known id, four for one that has not. Allocates nothing. Errors:
// none, everything is counted. Thread: one at a time; a sink must not feed its scanner.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/ids.hpp"
#include "io/mavlink/wire_format.hpp"

namespace godwit::io::mavlink {

// What a scanner has seen, by cause and by kind of message. Counters only grow. Thread: a value.
struct kind_counters {
  std::uint64_t received = 0;
  std::uint64_t bad_crc = 0; // what claimed to be of this kind; false starts count here too
};

struct scan_counters {
  std::uint64_t bytes = 0;
  std::uint64_t frames = 0;        // good ones, handed on
  std::uint64_t bad_crc = 0;       // one damaged frame may count several times, when its payload contains FD
  std::uint64_t unknown_id = 0;    // passed over by their length, their checksum unchecked
  std::uint64_t unknown_flag = 0;  // whole and right, but with an incompatibility flag that we do not know
  std::uint64_t v1_frames = 0;     // MAVLink 1, passed over
  std::uint64_t cut_off = 0;       // a frame began and the datagram ended
  std::uint64_t garbage_bytes = 0; // not part of a frame, good or passed over
  std::array<kind_counters, known_id_count> kinds{}; // by slot, see io/mavlink/ids.hpp

  [[nodiscard]] kind_counters of(std::uint32_t id) const {
    const auto* const info = find_message(id);
    return info != nullptr ? kinds[slot_of(*info)] : kind_counters{};
  }
};

// Which components speak on a link, and how many of their frames did not arrive.
//
// Each component numbers its frames on a link from 0 to 255 and around. A gap is the number of frames that are missing
// in between. A step of more than half the circle is taken as a frame that comes late or twice; two in a row, as a peer
// that began to count anew. A frame that is not believed is taken back. Source: the MAVLink guide, "Packet loss".
// Thread: a value.
struct sender_counters {
  sender who;
  std::uint8_t last_sequence = 0;
  std::uint8_t behind_in_a_row = 0;
  std::uint64_t received = 0;
  std::uint64_t lost = 0;
  std::uint64_t out_of_order = 0; // late or twice
};

class sender_table {
public:
  // A link has a handful of components. Who comes when the table is full is heard all the same, but not followed.
  static constexpr std::size_t max_senders = 32;

  void note(sender who, std::uint8_t sequence) {
    if (last_ < used_ && senders_[last_].who == who) {
      before_ = senders_[last_];
      count(senders_[last_], sequence);
    } else {
      note_other(who, sequence);
    }
  }
  // The frame that was noted last is not believed: nothing of it counts.
  void take_back();

  // The same for a frame that could not be verified: it does not make a sender known.
  void note_unverified(sender who, std::uint8_t sequence);

  [[nodiscard]] bool knows(sender who) const {
    return std::ranges::any_of(all(), [&](const sender_counters& each) { return each.who == who; });
  }
  [[nodiscard]] std::span<const sender_counters> all() const { return std::span(senders_).first(used_); }

private:
  static void count(sender_counters& each, std::uint8_t sequence);
  void note_other(sender who, std::uint8_t sequence);
  [[nodiscard]] sender_counters* find(sender who);

  std::array<sender_counters, max_senders> senders_{};
  std::size_t used_ = 0;
  std::size_t last_ = 0;                  // who spoke last probably speaks again
  std::optional<sender_counters> before_; // that one, before its last frame; none: it was not known
};

// In front of BYTES stands a frame of a known id, whole and with the right checksum.
[[nodiscard]] bool begins_with_whole_frame(byte_view bytes);

class scanner {
public:
  // Calls SINK(const frame_view&) for each frame that ends in BYTES. The view is good during the call.
  template <class Sink>
  void feed(byte_view bytes, Sink&& sink) {
    counters_.bytes += bytes.size();
    if (carried_ != 0)
      bytes = feed_carry(bytes, sink);
    search each{bytes.data(), bytes.data() + bytes.size(), bytes.data() + bytes.size()};
    while (const auto frame = next(each))
      sink(*frame);
    if (each.at != each.end)
      keep(each.at, each.end);
  }

  // No more bytes belong to what is waiting: it is searched for frames once more, and let go.
  template <class Sink>
  void end_of_datagram(Sink&& sink) {
    const auto* const end = carry_.data() + carried_;
    search each{carry_.data(), end, end, true};
    while (const auto frame = next(each))
      sink(*frame);
    carried_ = 0;
  }

  template <class Sink>
  void feed_datagram(byte_view bytes, Sink&& sink) {
    feed(bytes, sink);
    end_of_datagram(sink);
  }

  // As a piece of a stream, but for two things that a datagram tells. One that begins with a frame goes on with nothing
  // that was begun before: what waits is let go. And a frame of an unknown id at its end has nothing after it.
  template <class Sink>
  void feed_next_datagram(byte_view bytes, Sink&& sink) {
    if (carried_ != 0 && begins_with_frame(bytes))
      end_of_datagram(sink);
    feed(bytes, sink);
    if (is_unknown_frame_carried())
      end_of_datagram(sink);
  }

  // The frame that SINK was given last is not believed: its number counts for nothing.
  void disbelieve_last() { senders_.take_back(); }

  [[nodiscard]] const scan_counters& counters() const { return counters_; }
  [[nodiscard]] const sender_table& senders() const { return senders_; }
  [[nodiscard]] std::size_t waiting_bytes() const { return carried_; }

private:
  // One whole frame can wait: one of an unknown id, for the header of the next.
  static constexpr std::size_t max_decision = max_frame_size + header_size; // bytes that decide about the first of them
  static constexpr std::size_t max_carried = max_decision - 1;
  static constexpr std::size_t joint_size = max_carried + max_decision - 1; // decides about every byte of the carry

  struct search {
    const std::byte* at;
    const std::byte* end;
    const std::byte* stop;     // no frame is looked for from here on
    bool is_all = false;       // nothing follows the end
    bool cut_off_seen = false; // counted once
  };

  // The next good frame, and EACH moved after it. None: EACH is at its stop, or at what waits for more bytes.
  std::optional<frame_view> next(search& each);

  // Searches what begins in the carry, with as much of BYTES as that takes. Returns what is left of BYTES.
  template <class Sink>
  byte_view feed_carry(byte_view bytes, Sink& sink) {
    const auto joined = std::min(bytes.size(), joint_size - carried_);
    if (joined != 0)
      std::memcpy(carry_.data() + carried_, bytes.data(), joined);
    const auto* const boundary = carry_.data() + carried_;
    search each{carry_.data(), boundary + joined, boundary};
    while (const auto frame = next(each))
      sink(*frame);
    if (each.at < boundary) {
      assert(joined == bytes.size()); // with all that fits, everything up to the boundary would be decided
      keep(each.at, each.end);
      return {};
    }
    carried_ = 0;
    return bytes.subspan(static_cast<std::size_t>(each.at - boundary));
  }

  void keep(const std::byte* begin, const std::byte* end);

  enum class verdict { frame, pass_over, garbage, wait };
  verdict judge_v2(const search& each, std::size_t& size);
  verdict judge_unknown(const frame_view& frame, byte_view behind, bool is_all);
  [[nodiscard]] bool looks_like_frame(byte_view bytes) const; // from somebody who was heard before
  [[nodiscard]] bool begins_with_frame(byte_view bytes) const {
    return begins_with_whole_frame(bytes) || looks_like_frame(bytes);
  }
  [[nodiscard]] bool is_unknown_frame_carried() const;
  verdict judge_v1(const search& each, std::size_t& size);

  std::size_t carried_ = 0;
  std::array<std::byte, joint_size> carry_{};
  scan_counters counters_;
  sender_table senders_;
};

} // namespace godwit::io::mavlink
