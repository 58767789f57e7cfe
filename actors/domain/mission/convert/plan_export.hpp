// A mission as a plan of QGroundControl, in the form that it writes itself; the way back of plan_import.hpp.
//
// A survey becomes its survey pattern without lines: the ground station lays them when it opens the file. A return
// becomes the vehicle's own. The planned home is written as it is; without one the return point stands there. Losses:
// what a plan does not know (heights of fences and of the return point). Thread: pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "actors/domain/mission/convert/conversion.hpp"

namespace godwit::mission {

// MISSION keeps all rules.
[[nodiscard]] exported export_plan(const document& mission);

// TEXT, a plan that was read as a whole, as the ground station would write it again: with everything in it. Nothing for
// one of an older form.
[[nodiscard]] std::optional<std::string> plan_again(std::string_view text);

} // namespace godwit::mission
