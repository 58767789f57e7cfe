// From bytes to frames that may be believed, and from messages to frames that others may believe: numbering, identity,
// signatures, and the counters of all of it. One for each link.
//
// A frame is given out when the scanner found it sound and the verifier let it through. What the peers of a UDP port
// send does not mix: each has a scanner of its own. Errors: none, everything is counted. Thread: one at a time.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "actors/vehicle_link/effects.hpp"
#include "actors/vehicle_link/surface.hpp"
#include "io/link/status.hpp"
#include "io/mavlink/codec.hpp"
#include "io/mavlink/scanner.hpp"
#include "io/mavlink/signing/link_policy.hpp"
#include "io/mavlink/signing/signer.hpp"
#include "io/mavlink/signing/verifier.hpp"
#include "messages/vehicle_link/connection.hpp"

namespace godwit::vehicle_link {

// As many as a UDP link remembers. The one that was silent longest makes room.
inline constexpr std::size_t max_scanned_peers = 16;

// A stream that was silent for so long has lost the rest of what it began: let go of it. Longer than any pause inside a
// frame, 280 bytes at 9600 baud being 0.3 s.
inline constexpr std::int64_t stream_silence_ms = 500;

struct signing_settings {
  std::shared_ptr<const mavlink::secret_key> key; // none: the link is trusted, and nothing is signed
  mavlink::link_id link{};                        // our own number for this link
  mavlink::unsigned_policy unsigned_frames;       // who may come without a signature all the same
  mavlink::link_security security = mavlink::link_security::open;
};

class channel {
public:
  // CEILING: the signing time that an earlier life has reserved.
  channel(const signing_settings& signing, mavlink::signing_time ceiling);
  channel(const channel&) = delete;
  channel& operator=(const channel&) = delete;
  ~channel() = default;

  // MESSAGE as a frame from WHO, numbered and, where the link has a key, signed. Nothing: no timestamp is left.
  template <sent M>
  [[nodiscard]] std::optional<mavlink::frame_buffer> pack(const M& message, mavlink::sender who, std::int64_t wall_ns) {
    const auto sign = signer_ ? mavlink::signing::on : mavlink::signing::off;
    auto frame = mavlink::encode(message, who, tx_sequence_, sign);
    if (signer_ && !signer_->sign(frame, wall_ns))
      return std::nullopt;
    ++tx_sequence_;
    ++frames_out_;
    return frame;
  }

  // Calls TAKE(const frame_view&) for each frame that may be believed.
  template <class Take>
  void unpack(io::link::peer_id peer, bool is_datagram, mavlink::byte_view bytes, instant now, Take&& take) {
    const auto judged = [&](const mavlink::frame_view& frame) {
      if (is_believed(frame, now))
        take(frame);
    };
    auto& from = scanner_of(peer, now);
    if (is_datagram)
      from.feed_datagram(bytes, judged);
    else
      from.feed(bytes, judged);
  }

  // Lets go of frames whose rest did not come.
  template <class Take>
  void on_silence(instant now, Take&& take) {
    for (auto& [peer, each] : peers_)
      if (each.scanner->waiting_bytes() != 0 && now.monotonic_ns - each.last_ns >= stream_silence_ms * 1'000'000)
        each.scanner->end_of_datagram([&](const mavlink::frame_view& frame) {
          if (is_believed(frame, now))
            take(frame);
        });
  }

  [[nodiscard]] bool is_signing() const { return signer_.has_value(); }
  [[nodiscard]] bool signs_beyond_reservation() { return signer_ && signer_->clock().is_beyond_reservation(); }
  [[nodiscard]] std::optional<mavlink::signing_time> wanted_reservation(std::int64_t wall_ns);
  void reserved(mavlink::signing_time ceiling);
  [[nodiscard]] bool may_send_key() const { return security_ == mavlink::link_security::secure && key_ != nullptr; }
  [[nodiscard]] const mavlink::secret_key& key() const { return *key_; } // only if may_send_key()

  [[nodiscard]] std::uint64_t rejected() const { return verifier_.counts().rejected(); }
  [[nodiscard]] std::uint64_t frames_in() const { return frames_in_; }
  [[nodiscard]] std::uint64_t v1_frames() const;
  [[nodiscard]] const std::string& last_rejection() const { return last_rejection_; }

  // Fills in what health shows of it; VEHICLE is whose frames are followed for gaps.
  void describe(connection& out, std::optional<mavlink::sender> vehicle) const;

private:
  struct peer_entry {
    std::unique_ptr<mavlink::scanner> scanner; // 6 KiB each
    std::int64_t last_ns = 0;
  };

  [[nodiscard]] mavlink::scanner& scanner_of(io::link::peer_id peer, instant now);
  [[nodiscard]] bool is_believed(const mavlink::frame_view& frame, instant now);

  std::shared_ptr<const mavlink::secret_key> key_;
  mavlink::link_security security_;
  std::optional<mavlink::signer> signer_;
  mavlink::replay_table replays_;
  mavlink::verifier verifier_; // looks into replays_
  std::string last_rejection_;
  std::map<io::link::peer_id, peer_entry> peers_;
  std::uint8_t tx_sequence_ = 0;
  std::uint64_t frames_out_ = 0;
  std::uint64_t frames_in_ = 0;
  // Of peers that made room for others.
  std::uint64_t forgotten_errors_ = 0;
};

} // namespace godwit::vehicle_link
