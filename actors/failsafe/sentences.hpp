// What the failsafes say to people. Thread: pure.
#pragma once

#include <string>

#include "actors/failsafe/battery_filter.hpp"
#include "actors/failsafe/fence_watch.hpp"
#include "actors/failsafe/rules.hpp"

namespace godwit::failsafe {

// "the battery is at 14 %"
[[nodiscard]] std::string cause_of(rule why, const battery_verdict& level, const fence_verdict& fences);

// "the vehicle lands"
[[nodiscard]] std::string deed_of(action what);

} // namespace godwit::failsafe
