// What the executor makes of a plan that a station has uploaded. Thread: plain values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/mission.hpp"

namespace godwit::ground_port {

// The answer to plan_taken, which is told and not asked: the station hears it as the answer to its upload. Why a plan
// is not taken is said as a status_text.
struct plan_judged {
  io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission;
  std::uint32_t plan_id = 0;
  bool is_taken = false; // else the plan from before is still the one
  static constexpr auto fields =
      io::table("ground_port.plan_judged", io::field("type", &plan_judged::type),
                io::field("plan_id", &plan_judged::plan_id), io::field("is_taken", &plan_judged::is_taken));
};

} // namespace godwit::ground_port
