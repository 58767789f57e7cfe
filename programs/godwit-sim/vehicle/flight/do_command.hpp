// The DO commands of a mission that change something here. Thread: pure.
#pragma once

#include <optional>
#include <string>

#include "io/mavlink/messages/mission_transfer.hpp"
#include "programs/godwit-sim/vehicle/flight/craft.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::sim {

// DO_CHANGE_SPEED changes HOW_FAST, DO_SET_HOME changes HOME; jumps, delays, marks, cameras, servos and the like leave
// all as it is. The answer, if any, says why it was of no use.
[[nodiscard]] std::optional<std::string> carry_out(const io::mavlink::mission_item_int& command, const craft& what,
                                                   const position& here, pace& how_fast, position& home);

} // namespace godwit::sim
