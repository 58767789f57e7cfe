// What the executor tells ground_port, so that ground stations see how the mission goes. Sequences count from 0 in the
// plan that ground_port holds. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/mission.hpp"
#include "io/mavlink/enums/vehicle.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::ground_port {

// Becomes MISSION_CURRENT: at 1 Hz, and within 100 ms of a change. The executor tells it once a second as well, for a
// port that was restarted: until the first word, the mission of an armed vehicle can not be cleared. Ignored while
// PLAN_ID is not that of the mission that is held.
struct mission_progress {
  std::uint32_t plan_id = 0;
  std::uint16_t current = 0;
  io::mavlink::mission_state state = io::mavlink::mission_state::not_started;
  io::mavlink::mission_mode mode = io::mavlink::mission_mode::unknown;
  bool is_sent_elsewhere = false; // by a go to: the mission waits
  GODWIT_FIELDS(mission_progress, "ground_port.mission_progress", plan_id, current, state, mode, is_sent_elsewhere);
};

// Becomes MISSION_ITEM_REACHED, once for each. A crash repeats it: then the port tells what it has not told yet, and
// one that has begun anew itself tells nothing.
struct item_reached {
  std::uint16_t sequence = 0;
  std::string mission_id = {};
  std::uint32_t report_no = 0; // in the mission
  bool is_repeated = false;    // an earlier incarnation may have told it
  GODWIT_FIELDS(item_reached, "ground_port.item_reached", sequence, mission_id, report_no, is_repeated);
};

// Becomes STATUSTEXT, in several frames when it is longer than 50 characters.
struct status_text {
  io::mavlink::mav_severity severity = io::mavlink::mav_severity::info;
  std::string text;
  GODWIT_FIELDS(status_text, "ground_port.status_text", severity, text);
};

// The mission is another one now, and no station has sent it. Stations that download get this one. No items: none.
struct set_mission {
  std::vector<io::mavlink::mission_item_int> items;
  GODWIT_FIELDS(set_mission, "ground_port.set_mission", items);
};

// What the executor makes of a plan that a station has uploaded or cleared. Thread: plain values.
enum class plan_verdict {
  taken,    // it is the one from now on; a clear: the vehicle has no plan any more
  refused,  // the plan from before is still the one
  no_space, // the same, because the vehicle has no room for it
  failed,   // a clear: it is gone here, and may still be on the vehicle
  bringing  // it goes to the vehicle now, and another word follows
};

GODWIT_ENUM_NAMES(plan_verdict, taken, refused, no_space, failed, bringing);

// The answer to plan_taken and plan_cleared, which are told and not asked: the station hears it as the answer to its
// upload or clear. Why it is not taken is said as a status_text.
struct plan_judged {
  io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission;
  std::uint32_t plan_id = 0; // 0: of a clear
  plan_verdict verdict = plan_verdict::refused;
  GODWIT_FIELDS(plan_judged, "ground_port.plan_judged", type, plan_id, verdict);
};

} // namespace godwit::ground_port
