// Who has the vehicle, in the words of flight_status, for people. Nothing is decided by it. Thread: pure.
#pragma once

#include <string_view>

#include "actors/executor/flight/flight_context.hpp"

namespace godwit::executor {

// "godwit", "person", "failsafe", "autopilot_end", "autopilot_failsafe"; "unclear" until the vehicle has told;
// "pending" until it has answered a command of a ground station; "nobody" while no flight is watched.
[[nodiscard]] std::string_view authority_text(const flight_context& flight);

} // namespace godwit::executor
