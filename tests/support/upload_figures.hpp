// How long uploads take against vehicles with the habits of real ones, in virtual time: for the test that holds the
// figures and for the bench that prints them. Thread: pure.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/support/transfer_world.hpp"

namespace godwit::tests {

struct upload_peer {
  const char* name;
  mission_server::server_profile server_profile;
  transfer::peer_profile profile;
};

// Room for long plans: how much a vehicle stores is not what is measured.
inline constexpr int roomy = 2'000;

[[nodiscard]] inline upload_peer px4_peer() {
  auto server_profile = mission_server::px4_profile();
  server_profile.capacity = roomy;
  return {"px4", server_profile, transfer::profile_for(io::mavlink::mav_autopilot::px4)};
}

[[nodiscard]] inline upload_peer copter_peer() {
  auto server_profile = mission_server::ardupilot_copter_profile();
  server_profile.capacity = roomy;
  return {"copter", server_profile, transfer::profile_for(io::mavlink::mav_autopilot::ardupilotmega)};
}

[[nodiscard]] inline upload_peer rover_peer() {
  auto server_profile = mission_server::ardupilot_rover_profile();
  server_profile.capacity = roomy;
  return {"rover", server_profile, transfer::profile_for(io::mavlink::mav_autopilot::ardupilotmega)};
}

struct upload_figures {
  double median_s = 0;
  double worst_s = 0;
  double median_bytes = 0; // both ways
  double sent_ratio = 0;   // items sent, of those in the plan, mean
  int failures = 0;        // not accepted
  int untruthful = 0;      // what is said and what the vehicle holds do not agree
};

// SEEDS uploads of ITEMS each, every one over a line and with a plan of its own.
[[nodiscard]] inline upload_figures measure_uploads(const upload_peer& peer, const line_settings& line, int items,
                                                    int seeds) {
  upload_figures result;
  std::vector<double> seconds;
  std::vector<double> bytes;
  std::uint64_t sent = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    transfer_world world(peer.server_profile, peer.profile, line, static_cast<std::uint64_t>(seed));
    const auto plan = mission_of(items, static_cast<std::uint64_t>(seed));
    const auto outcome = world.upload(plan);
    const bool is_accepted = outcome.verdict == transfer::verdict::accepted;
    result.failures += is_accepted ? 0 : 1;
    result.untruthful += is_accepted == holds(world.vehicle(), plan) ? 0 : 1;
    seconds.push_back(static_cast<double>(outcome.duration_ns) * 1e-9);
    sent += outcome.effort.items_sent;
    bytes.push_back(static_cast<double>(world.ours().line.bytes()));
  }
  std::sort(seconds.begin(), seconds.end());
  std::sort(bytes.begin(), bytes.end());
  result.median_s = seconds[seconds.size() / 2];
  result.worst_s = seconds.back();
  result.sent_ratio = static_cast<double>(sent) / (static_cast<double>(items) * seeds);
  result.median_bytes = bytes[bytes.size() / 2];
  return result;
}

// The same client with a window of 1: answers requests and sends again on its own round trip.
[[nodiscard]] inline upload_peer request_by_request(upload_peer peer) {
  peer.profile.first_window = 1;
  peer.profile.max_window = 1;
  peer.profile.items_follow_count = false;
  return peer;
}

// Each way 15 ms, as over a network; LOSS of each frame, each way.
[[nodiscard]] inline line_settings network(double loss) { return {.delay_ns = 15'000'000, .loss = loss}; }

// A telemetry radio: half-duplex, 57600 baud, 60 ms there and back.
[[nodiscard]] inline line_settings radio(double loss) { return {.delay_ns = 30'000'000, .loss = loss, .baud = 57'600}; }

} // namespace godwit::tests
