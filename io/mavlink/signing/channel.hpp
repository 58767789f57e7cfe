// From bytes to frames that may be believed, and from messages to frames that others may believe: numbering, identity,
// signatures, and the counters of all of it. One for each link.
//
// A frame is given out when the scanner found it sound and the verifier let it through. What the peers of a UDP port
// send does not mix: each has a scanner of its own, also for frames that are split over datagrams. Frames are numbered
// for each component that we speak as. Errors: none, everything is counted. Thread: one at a time.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/link/status.hpp"
#include "io/mavlink/codec.hpp"
#include "io/mavlink/scanner.hpp"
#include "io/mavlink/signing/link_policy.hpp"
#include "io/mavlink/signing/signer.hpp"
#include "io/mavlink/signing/verifier.hpp"
#include "io/time_units.hpp"

namespace godwit::io::mavlink {

// As many as a UDP link remembers. The one that was silent longest makes room.
inline constexpr std::size_t max_scanned_peers = 16;

// As whom one process speaks on one link: itself, the autopilot that it stands in for, each of them once more after the
// vehicle's system id became known, and those whose frames it passes on. The one that spoke first makes room, and would
// begin at 0 again.
inline constexpr std::size_t max_numbered_speakers = 24;

// A stream that was silent for so long has lost the rest of what it began: let go of it. Longer than any pause inside a
// frame, 280 bytes at 9600 baud being 0.3 s.
inline constexpr std::int64_t stream_silence_ms = 500;

using godwit::instant; // the first clock for deadlines, the second for signatures

struct signing_settings {
  std::shared_ptr<const secret_key> key; // none: the link is trusted, and nothing is signed
  link_id link{};                        // our own number for this link
  unsigned_policy unsigned_frames;       // who may come without a signature all the same
  link_security security = link_security::open;
  // Outlives a channel that is made anew after a crash: what was replayed before the crash is one after it too.
  std::shared_ptr<replay_table> replays = std::make_shared<replay_table>();
};

// Nobody listens or speaks there but the two ends: the key may be given to the other one, and until that signs its
// frames come without a signature.
inline void mark_secure(signing_settings& link) {
  link.security = link_security::secure;
  link.unsigned_frames = unsigned_policy::accept_all();
}

struct channel_count {
  std::string name; // of what it counts
  std::uint64_t count = 0;
};

// What health shows of a channel. The numbers only rise.
struct channel_report {
  bool is_signing = false;
  std::uint64_t frames_in = 0; // believed ones
  std::uint64_t frames_out = 0;
  std::uint64_t parse_errors_total = 0;
  std::vector<channel_count> parse_errors; // by cause
  std::vector<channel_count> kind_errors;  // bad checksums by message kind
  std::uint64_t signed_in = 0;             // of the believed ones
  std::uint64_t signing_rejected = 0;
  std::vector<channel_count> signing_errors; // by cause
  std::uint64_t followed_in = 0;             // frames of the sender that was asked for, unknown ones too
  std::uint64_t sequence_gaps = 0;           // the same: frames of it that did not arrive
  std::uint8_t last_sequence = 0;            // the same
};

class channel {
public:
  // CEILING: the signing time that an earlier life has reserved.
  channel(const signing_settings& signing, signing_time ceiling);
  channel(const channel&) = delete;
  channel& operator=(const channel&) = delete;
  ~channel() = default;

  // MESSAGE as a frame from WHO, numbered and, where the link has a key, signed. Nothing: no timestamp is left.
  template <message M>
  [[nodiscard]] std::optional<frame_buffer> pack(const M& what, sender who, std::int64_t wall_ns) {
    auto& sequence = sequence_of(who);
    auto frame = encode(what, who, sequence, signer_ ? signing::on : signing::off);
    if (signer_ && !signer_->sign(frame, wall_ns))
      return std::nullopt;
    ++sequence;
    ++frames_out_;
    return frame;
  }

  // A message of WHO that is passed on: PAYLOAD as it came, numbered and signed anew. Nothing: no such id is known, or
  // as above.
  [[nodiscard]] std::optional<frame_buffer> pack_as_said(std::uint32_t id, byte_view payload, sender who,
                                                         std::int64_t wall_ns);

  // Calls TAKE(const frame_view&) for each frame that may be believed.
  template <class Take>
  void unpack(link::peer_id peer, bool is_datagram, byte_view bytes, instant now, Take&& take) {
    auto& from = scanner_of(peer, now);
    const auto judged = [&](const frame_view& frame) {
      if (is_believed(frame, now))
        take(frame);
      else
        from.disbelieve_last();
    };
    if (is_datagram)
      from.feed_next_datagram(bytes, judged);
    else
      from.feed(bytes, judged);
  }

  // Lets go of frames whose rest did not come. Calls TAKE(peer, frame).
  template <class Take>
  void on_silence(instant now, Take&& take) {
    for (auto& entry : peers_) {
      const auto peer = entry.first; // clang 14 captures no structured binding
      auto& each = entry.second;
      if (each.scan->waiting_bytes() != 0 && now.monotonic_ns - each.last_ns >= stream_silence_ms * 1'000'000)
        each.scan->end_of_datagram([&](const frame_view& frame) {
          if (is_believed(frame, now))
            take(peer, frame);
          else
            each.scan->disbelieve_last();
        });
    }
  }

  [[nodiscard]] bool is_signing() const { return signer_.has_value(); }
  [[nodiscard]] bool signs_beyond_reservation() { return signer_ && signer_->clock().is_beyond_reservation(); }
  // FRAME was believed, and is of the other end of the link: where it is signed, we sign at its time from now on.
  void follow(const frame_view& frame) {
    if (signer_ && frame.is_signed())
      signer_->clock().follow(signature_of(frame).time);
  }
  // By how much it signs ahead of our own time.
  [[nodiscard]] std::int64_t followed_ahead_s(std::int64_t wall_ns) {
    return signer_ ? static_cast<std::int64_t>(signer_->clock().followed_ahead(wall_ns) / signing_units_per_s) : 0;
  }
  [[nodiscard]] std::optional<signing_time> wanted_reservation(std::int64_t wall_ns);
  void reserved(signing_time ceiling);
  [[nodiscard]] bool may_send_key() const { return security_ == link_security::secure && key_ != nullptr; }
  [[nodiscard]] const secret_key& key() const { return *key_; } // only if may_send_key()

  [[nodiscard]] std::uint64_t rejected() const { return verifier_.counts().rejected(); }
  [[nodiscard]] std::uint64_t frames_in() const { return frames_in_; }
  [[nodiscard]] std::uint64_t v1_frames() const;
  [[nodiscard]] const std::string& last_rejection() const { return last_rejection_; }

  // The sequence number of the next frame from WHO.
  [[nodiscard]] std::uint8_t next_sequence(sender who) const;
  // FOLLOWED: whose frames are looked at for gaps. FROM: from where they come, so that frames under its name from
  // elsewhere are no gaps; every_peer: from wherever.
  [[nodiscard]] channel_report report(std::optional<sender> followed, link::peer_id from = link::every_peer) const;

private:
  struct peer_entry {
    std::unique_ptr<scanner> scan; // 6 KiB each
    std::int64_t last_ns = 0;
  };
  struct speaker {
    sender who;
    std::uint8_t next = 0;
  };

  [[nodiscard]] scanner& scanner_of(link::peer_id peer, instant now);
  [[nodiscard]] bool is_believed(const frame_view& frame, instant now);
  [[nodiscard]] std::uint8_t& sequence_of(sender who);

  std::shared_ptr<const secret_key> key_;
  link_security security_;
  std::optional<signer> signer_;
  std::shared_ptr<replay_table> replays_;
  verifier verifier_; // looks into replays_
  std::string last_rejection_;
  std::map<link::peer_id, peer_entry> peers_;
  std::vector<speaker> speakers_;
  std::uint64_t frames_out_ = 0;
  std::uint64_t frames_in_ = 0;
  // Of peers that made room for others.
  std::uint64_t forgotten_errors_ = 0;
};

} // namespace godwit::io::mavlink
