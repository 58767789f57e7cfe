// The commands that can be items of a plan: those that some vehicle takes, by the table of commands
// (actors/domain/mission/commands).
//
// Orders are none, though their numbers are commands as well: to arm, to start the mission, to go somewhere now.
// Thread: pure.
#pragma once

#include <cstdint>
#include <optional>

#include "io/mavlink/enums.hpp"

namespace godwit::ground_port::mission_server {

namespace mavlink = io::mavlink;

// Do x and y say where?
enum class item_place { anywhere, at_a_position };

// Nothing: it is no item of such a plan.
[[nodiscard]] std::optional<item_place> place_of(std::uint16_t command, mavlink::mav_mission_type type);

} // namespace godwit::ground_port::mission_server
