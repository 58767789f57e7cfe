// What comes of an event: reports to the missions service, the answer to an assignment, what the executor has to look
// at, and news for it. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mission/change.hpp"
#include "messages/mission/progress.hpp"
#include "runtime/effect_kind.hpp"

namespace godwit::executor::progress {

struct assignment_answered {
  std::string mission_id;
  std::string assignment_id;
  mission::assignment_response response;
  GODWIT_FIELDS(assignment_answered, "executor.progress_assignment_answered", mission_id, assignment_id, response);
};

// An upload may or may not have come to the vehicle: wait until no transfer is under way, ask for its plan id, and tell
// vehicle_looked_at.
struct look_at_vehicle {
  static constexpr auto goes_out = runtime::effect_kind::at_once;
  static constexpr auto fields = io::table("executor.progress_look_at_vehicle");
};

// The plan id does not resolve it: read the plan back, compare it by meaning, and tell plan_read_back.
struct read_plan_back {
  static constexpr auto goes_out = runtime::effect_kind::at_once;
  static constexpr auto fields = io::table("executor.progress_read_plan_back");
};

// A command may or may not have come to the vehicle: look where it is, and tell start_ended.
struct resolve_start {
  static constexpr auto goes_out = runtime::effect_kind::at_once;
  std::uint16_t sequence = 0;
  GODWIT_FIELDS(resolve_start, "executor.progress_settle_start", sequence);
};

enum class progress_event_kind {
  generation_opened, // a plan or a start was accepted; nothing counts yet
  armed,             // the vehicle is seen at the start: from now on it counts
  not_at_start,      // the vehicle has our plan and is elsewhere in it: nothing counts, a set-current is needed
  plan_done,         // the last item of the plan that moves the vehicle is done
  mission_complete,  // and no further plan follows
  upload_failed,     // the plan before stays in force
  place_missed,      // its track contradicts that it was at an item, which the reason names
  act_failed,        // the reason says which, and what the vehicle reported
  pictures_missing,  // of a line: the reason is the sentence
  foreign_plan,      // paused: the vehicle holds a plan that is not ours
  infeasible_plan,   // paused: the vehicle finds that the plan that was brought to it can not be flown
  vehicle_restarted  // paused: what the vehicle flew is lost
};

GODWIT_ENUM_NAMES(progress_event_kind, generation_opened, armed, not_at_start, plan_done, mission_complete,
                  upload_failed, place_missed, act_failed, pictures_missing, foreign_plan, infeasible_plan,
                  vehicle_restarted);

struct progress_event {
  static constexpr auto goes_out = runtime::effect_kind::at_once;
  progress_event_kind kind = progress_event_kind::generation_opened;
  std::uint32_t generation = 0;
  std::string reason; // sentence for people; empty when all is well
  GODWIT_FIELDS(progress_event, "executor.progress_news", kind, generation, reason);
};

using effect = std::variant<mission::progress_report, assignment_answered, look_at_vehicle, read_plan_back,
                            resolve_start, progress_event>;
using effects = std::vector<effect>;

} // namespace godwit::executor::progress
