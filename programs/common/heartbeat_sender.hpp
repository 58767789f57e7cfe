// Tells the other end that somebody listens: a heartbeat a second, signed where there is a key.
//
// It says what this is, an onboard controller without a flight mode, and never a ground station: that would hide from
// the autopilot that the human's link is gone. Signed with the wall clock, on a link id of its own, so that a godwit
// that runs on the same vehicle keeps its timestamps to itself. Thread: one at a time. Source: MAVLink's minimal.xml
// (MAV_TYPE 18, MAV_AUTOPILOT 8); the MAVLink guide, "Message Signing".
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "io/link/link.hpp"
#include "io/mavlink/signing/signer.hpp"

namespace godwit::programs {

inline constexpr io::mavlink::sender default_identity{1, 191}; // of the vehicle, MAV_COMP_ID_ONBOARD_COMPUTER
inline constexpr std::chrono::seconds heartbeat_period{1};

class heartbeat_sender {
public:
  static constexpr io::mavlink::link_id signing_link{255};

  heartbeat_sender(io::mavlink::sender identity, std::optional<io::mavlink::secret_key> key);

  // WALL_NS since 1970, UTC.
  void send(io::link::link& to, std::int64_t wall_ns);

private:
  io::mavlink::sender identity_;
  std::optional<io::mavlink::signer> signer_;
  std::uint8_t sequence_ = 0;
};

} // namespace godwit::programs
