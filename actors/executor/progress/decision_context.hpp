// One event being handled: the state, what comes of it, and the time. Reports and news are written through it, so that
// their numbers are given in one place. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "actors/executor/progress/effects.hpp"
#include "actors/executor/progress/plan_map.hpp"
#include "actors/executor/progress/state.hpp"

namespace godwit::executor::progress {

struct decision_context {
  state& s;
  effects& out;
  std::int64_t now_ns; // since 1970 (UTC)
};

// What is known of an item beside that the vehicle has gone on from it.
struct item_findings {
  std::optional<mission::act_outcome> outcome;
  std::optional<mission::picture_count> pictures;
};

// About one item of the mission. The plan is there.
void report_item(decision_context& t, mission::progress_kind kind, const mapped_item& item, bool is_inferred,
                 const item_findings& findings = {});

// About the open mission as a whole.
void report_mission(decision_context& t, mission::progress_kind kind, bool is_inferred);

// NEWS of the newest generation.
void tell(decision_context& t, progress_event_kind kind, std::string reason = {});

} // namespace godwit::executor::progress
