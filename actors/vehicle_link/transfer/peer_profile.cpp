#include "actors/vehicle_link/transfer/peer_profile.hpp"

namespace godwit::vehicle_link::transfer {

namespace {

// Enough that an ArduPilot with turns of 2.5 ms is kept busy for the first round trip of a usual radio, and little
// enough that on a slow line it is not more than a tenth of a second.
constexpr int first_ahead = 10;
constexpr int most_ahead = 48;

// What is added to the time after which a vehicle was seen to give up: its last message may have been lost.
constexpr std::int64_t margin_ns = 500 * ns_per_ms;

peer_profile px4() {
  peer_profile result;
  result.autopilot = mavlink::mav_autopilot::px4;
  result.first_window = first_ahead;
  result.max_window = most_ahead;
  result.is_atomic = true;
  result.keeps_plan_ids = true;
  result.acknowledges_last_again = true;
  result.patience_ns = 5'000 * ns_per_ms + margin_ns;
  return result;
}

peer_profile ardupilot() {
  peer_profile result;
  result.autopilot = mavlink::mav_autopilot::ardupilotmega;
  result.first_window = first_ahead;
  result.max_window = most_ahead;
  result.items_follow_count = true;
  result.max_requests_ahead = most_ahead;
  result.first_item_is_home = true;
  result.obeys_cancel = false;
  result.error_is_warning = true;
  result.patience_ns = 8'000 * ns_per_ms + margin_ns;
  return result;
}

} // namespace

peer_profile profile_for(mavlink::mav_autopilot autopilot) {
  switch (autopilot) {
  case mavlink::mav_autopilot::px4:
    return px4();
  case mavlink::mav_autopilot::ardupilotmega:
    return ardupilot();
  default:
    break;
  }
  peer_profile unknown;
  unknown.autopilot = autopilot;
  return unknown;
}

} // namespace godwit::vehicle_link::transfer
