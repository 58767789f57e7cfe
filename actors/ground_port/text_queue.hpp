// STATUSTEXT on its way: long texts in pieces, and not more frames than a slow line carries beside all else.
//
// A few go out at once, further ones each gap_ns: 20 a second are 1.3 kB/s, a quarter of a 57600 baud line. When it is
// full the newest is dropped as a whole and counted. Pure. Thread: one at a time. Source: STATUSTEXT (253).
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string_view>

#include "io/link/status.hpp"
#include "io/mavlink/enums/vehicle.hpp"
#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::ground_port {

class text_queue {
public:
  static constexpr std::size_t max_waiting_frames = 32;
  static constexpr std::size_t max_frames_of_a_text = 4; // 199 characters; what is longer is cut off
  static constexpr std::int64_t gap_ns = 50'000'000;
  static constexpr std::int64_t at_once = 8; // frames, after a while of silence

  struct entry {
    io::link::peer_id to = io::link::every_peer;
    io::mavlink::statustext frame;
  };

  void put(io::mavlink::mav_severity severity, std::string_view text, io::link::peer_id to = io::link::every_peer);

  // The next one, if its time has come.
  [[nodiscard]] std::optional<entry> due(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_due_ns() const {
    return waiting_.empty() ? std::numeric_limits<std::int64_t>::max() : paid_until_ns_ - (at_once - 1) * gap_ns;
  }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; } // texts

private:
  std::deque<entry> waiting_;
  std::int64_t paid_until_ns_ = 0; // each frame pays for one gap, at most at_once of them in advance
  std::uint16_t last_id_ = 0;
  std::uint64_t dropped_ = 0;
};

} // namespace godwit::ground_port
