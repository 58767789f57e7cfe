// What the executor makes of a plan that a station has uploaded or cleared. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/mission.hpp"

namespace godwit::ground_port {

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
