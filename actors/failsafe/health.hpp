// What of the failsafes' own senses is missing, and what they do, in one word and one sentence for people.
//
// The colour is that of the worst; the sentences of all are joined. Thread: pure.
#pragma once

#include <optional>
#include <string>

#include "actors/failsafe/battery_filter.hpp"
#include "actors/failsafe/effects.hpp"
#include "actors/failsafe/fence_watch.hpp"
#include "actors/failsafe/flight_watch.hpp"
#include "actors/failsafe/link_ladder.hpp"
#include "messages/failsafe/types.hpp"

namespace godwit::failsafe {

struct findings {
  flight_now flight;
  vehicle_class what = vehicle_class::unknown;
  battery_verdict battery;
  fence_finding fences = fence_finding::no_fences;
  link_phase link = link_phase::off;
  bool taken_over = false;
  bool limits_refused = false;
  std::optional<told_reaction> reacts;
  std::optional<rule> returns_by_plan = {};
};

[[nodiscard]] runtime::condition judge_health(const findings& all);

} // namespace godwit::failsafe
