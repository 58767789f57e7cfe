// Of whose plan a MISSION_CURRENT tells.
//
// With plan ids: by the id. Without: by the number of items, which is all that there is; a foreign plan of the same
// length passes for ours. A PX4 that finds ours infeasible has its id and no mission. A vehicle whose id was not
// learned with the upload shows it in its first message that fits. Thread: pure. Source: MISSION_CURRENT (42).
#pragma once

#include <cstdint>

#include "actors/executor/progress/state.hpp"
#include "io/mavlink/messages/mission.hpp"

namespace godwit::executor::progress {

enum class plan_match {
  ours,
  infeasible, // ours, and the vehicle finds that it can not be flown
  other,      // another plan, or none
  not_told    // the message lacks what would say it
};

[[nodiscard]] plan_match match_of(const io::mavlink::mission_current& message, const followed_plan& plan);

// While an upload is under way: an id that is not the one before may be that of the new plan.
[[nodiscard]] bool may_be_uploaded(const io::mavlink::mission_current& message, const pending_upload& upload);

} // namespace godwit::executor::progress
