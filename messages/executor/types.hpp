// What others say to the executor about the mission, and what it answers. Plain values.
//
// Only what a ground station can cause stands here. A request that makes the vehicle act carries a key and the last
// moment at which it may be obeyed: a request that comes to the executor late, because it or the asker was being
// restarted, starts nothing. Sequences count from 0 in the plan of the station. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/mission.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::executor {

// Who asked: a station's system and component id.
struct station {
  std::uint8_t system = 0;
  std::uint8_t component = 0;
  GODWIT_FIELDS(station, "executor.station", system, component);
  bool operator==(const station&) const = default;
};

// Fly the mission from item FIRST to item LAST. The items were looked at: both are in the plan, FIRST is not after
// LAST. Whether the vehicle is ready and armed is the executor's to say. Answered with start_answer.
struct start_mission {
  std::uint64_t key = 0; // new for each start that is meant
  std::uint16_t first = 0;
  std::uint16_t last = 0;
  std::uint32_t plan_id = 0; // of the plan that is meant: the one of the last plan_taken
  station asked_by;
  std::int64_t obey_until_ns = 0; // ns since 1970 (UTC); later it is answered `too_late` and starts nothing
  bool by_mode = false; // the mission mode was asked for: who stands disarmed in it is armed by its station next
  GODWIT_FIELDS(start_mission, "executor.start_mission", key, first, last, plan_id, asked_by, obey_until_ns, by_mode);
};

enum class start_verdict {
  started,       // the vehicle is in its mission mode, from the item that was asked for
  awaits_arming, // it stands disarmed in its mission mode; by_mode alone. The arm of the same station starts it
  not_ready,     // a preflight check fails or has not ended: `reason` says which
  disarmed,      // and starting does not arm
  no_such_item,  // or another plan is held by now
  too_late,      // obey_until_ns had passed
  failed         // it was tried: `reason` says how far it came
};

GODWIT_ENUM_NAMES(start_verdict, started, awaits_arming, not_ready, disarmed, no_such_item, too_late, failed);

struct start_answer {
  std::uint64_t key = 0;
  start_verdict verdict = start_verdict::failed;
  std::string reason; // sentence for people; empty when started
  GODWIT_FIELDS(start_answer, "executor.start_answer", key, verdict, reason);
};

// The mission runs: go to this item now. Asking twice for the same item does no harm. Answered with current_answer.
struct set_current {
  std::uint16_t index = 0;
  std::uint32_t plan_id = 0;
  station asked_by;
  GODWIT_FIELDS(set_current, "executor.set_current", index, plan_id, asked_by);
};

enum class current_verdict {
  going,        // the vehicle is on its way there
  not_running,  // the mission does not run any more
  no_such_item, // or another plan is held by now
  not_now,      // a pilot has the vehicle, or a failsafe acts
  failed        // it was tried
};

GODWIT_ENUM_NAMES(current_verdict, going, not_running, no_such_item, not_now, failed);

struct current_answer {
  current_verdict verdict = current_verdict::failed;
  std::string reason; // sentence for people; empty when going
  GODWIT_FIELDS(current_answer, "executor.current_answer", verdict, reason);
};

// A station has uploaded a plan, and has been or is being told that it is held.
struct plan_taken {
  io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission;
  std::uint32_t plan_id = 0;
  std::vector<io::mavlink::mission_item_int> items; // as the station sent them
  station by;
  GODWIT_FIELDS(plan_taken, "executor.plan_taken", type, plan_id, items, by);
};

// A station has cleared its plan.
struct plan_cleared {
  io::mavlink::mav_mission_type type = io::mavlink::mav_mission_type::mission;
  station by;
  GODWIT_FIELDS(plan_cleared, "executor.plan_cleared", type, by);
};

} // namespace godwit::executor
