// How the vehicle at the other end behaves in a transfer, as far as it matters to the one who sends.
//
// The numbers are what PX4 1.17 and ArduPilot 4.7 were seen to do on the wire. A vehicle that is neither gets what the
// MAVLink mission protocol promises and nothing more: request by request, one item for each.
//
// | Peer      | ahead | first items with COUNT | asks again | gives up              | old plan until done | cancel  |
// |-----------|-------|------------------------|------------|-----------------------|---------------------|---------|
// | PX4       | 48    | no                     | 0.26 s     | 5 s, silently         | yes                 | obeyed  |
// | ArduPilot | 48    | yes                    | 1 s        | 8 s, ACK CANCELLED    | no                  | ignored |
// | unknown   | 1     | no                     | -          | taken for 8 s         | not relied on       | obeyed  |
//
// Thread: values.
#pragma once

#include <cstdint>

#include "io/mavlink/enums.hpp"

#include "io/time_units.hpp"

namespace godwit::vehicle_link::transfer {

namespace mavlink = io::mavlink;

// A vehicle that is busy is waited for so many times its patience: what it is busy with may have begun just now.
inline constexpr int patience_with_busy = 2;

// What opens a conversation is said at least so often before the vehicle is taken for absent: of two lost out of five,
// there and back, all eight are lost once in three thousand times.
inline constexpr int min_tries = 8;

struct peer_profile {
  mavlink::mav_autopilot autopilot = mavlink::mav_autopilot::generic;

  // Items may be sent ahead of their requests: so many at first, and so many at most. 48 items are 2.4 kB, which the
  // receive buffers of flight controllers hold.
  int first_window = 1;
  int max_window = 1;

  // The first window may follow MISSION_COUNT without waiting for the first request. ArduPilot takes one message in
  // each turn of its main loop, so that the turns of the first round trip are not lost. PX4 refuses a second COUNT once
  // it has taken an item, so there a lost first request would cost more than the round trip that is won.
  bool items_follow_count = false;

  // Any item can be asked for at any time in a download, so many at once.
  int max_requests_ahead = 1;

  // The item with sequence 0 of a mission is home, and not what was uploaded.
  bool first_item_is_home = false;

  // The old plan stays until the new one is complete.
  bool is_atomic = false;

  // MISSION_CURRENT carries an id of each plan; 0 means that there is none, and not that it is not told.
  bool keeps_plan_ids = false;

  // MISSION_ACK(OPERATION_CANCELLED) ends a transfer.
  bool obeys_cancel = true;

  // MISSION_ACK(ERROR) does not mean that a transfer has ended; it also comes to a last item that was sent twice.
  bool error_is_warning = false;

  // The last item, sent again after all was taken, is acknowledged again as accepted.
  bool acknowledges_last_again = false;

  // The vehicle has given up by itself when it was out of touch for so long. To give up earlier would be to fail where
  // the vehicle still waits; to restart earlier would be to disturb it.
  std::int64_t patience_ns = 8'500 * ns_per_ms;
};

[[nodiscard]] peer_profile profile_for(mavlink::mav_autopilot autopilot);

} // namespace godwit::vehicle_link::transfer
