// MAV_CMD_MISSION_START: may the mission begin, and between which items?
//
// Asked in this order, the first that applies decides:
//
//   a parameter that is not finite, negative or not integral       DENIED
//   no mission                                                     FAILED
//   first >= count                                                 FAILED
//   last < first, or last >= count (last 0: to the end)            DENIED
//   a transfer is running, or the vehicle is not ready             TEMPORARILY_REJECTED
//   disarmed, and starting does not arm                            DENIED
//   otherwise                                                      ACCEPTED
//
// Each refusal has a sentence for people, short enough for one STATUSTEXT (50 characters) where it can be. Sequences
// count from 0. Thread: pure. Source: MAV_CMD_MISSION_START (300).
#pragma once

#include <cstdint>
#include <string>

#include "io/mavlink/enums.hpp"

namespace godwit::ground_port::vehicle_role {

struct start_request {
  float first_item = 0;
  float last_item = 0;
};

struct start_situation {
  int item_count = 0;
  bool is_transferring = false;
  std::string not_ready; // why the mission can not be flown now; empty: it can
  bool is_armed = false;
  bool arms_on_start = false;
};

struct start_decision {
  io::mavlink::mav_result result = io::mavlink::mav_result::failed;
  int first = 0;    // with ACCEPTED
  int last = 0;     // with ACCEPTED
  std::string text; // "Mission started", or why not
};

[[nodiscard]] start_decision decide_start(const start_request& what, const start_situation& now);

} // namespace godwit::ground_port::vehicle_role
