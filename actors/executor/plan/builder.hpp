// From a mission, or the rest of it, to the plans that a vehicle flies one after the other.
//
//   mission   up  out  land │ up  back  land      A landing or a return ends a plan: no autopilot goes on in the same
//   plans     0   0    0    │ 1   1     1         plan after it. The next one begins on the ground where that one
//   ended.
//
// Items that follow the last landing and have nothing to fly belong to the plan before them. Each item of the mission
// from the first one on is in exactly one plan, and the maps say so with the indices of the mission. What can not be
// said in vehicle items is refused with a sentence: which item, what, and what to do; nothing is left out in silence
// but what item_planner.hpp lists. The mission keeps the rules of actors/domain/mission/rules.hpp. Later plans are
// planned for where the vehicle should be then; plan again, from their first item on, when it is there. Thread: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <tl/expected.hpp>

#include "actors/executor/plan/flight_plan.hpp"
#include "actors/executor/plan/plan_error.hpp"
#include "actors/executor/plan/setting.hpp"
#include "actors/executor/progress/state.hpp"
#include "messages/mission/document.hpp"

namespace godwit::executor::plan {

// Where the mission is to be taken up.
struct plan_from {
  std::size_t item_index = 0;
  std::uint32_t lines_before = 0;                // of that item, when it is a survey: already flown, see lines_done_at
  std::vector<progress::taken_jump> jumps = {};  // so often was each of them taken
  std::optional<progress::begun_line> line = {}; // that was left before its end, laid as it is now
};

// At least one plan.
[[nodiscard]] tl::expected<std::vector<flight_plan>, plan_error>
build_plans(const mission::document& mission, const plan_setting& setting, const plan_from& from = {});

} // namespace godwit::executor::plan
