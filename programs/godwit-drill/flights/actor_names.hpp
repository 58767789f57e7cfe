// The actors of a flight, by their names in godwitd. Thread: constants.
#pragma once

#include <array>

namespace godwit::drill {

inline constexpr std::array actor_names{"vehicle_link",   "failsafe", "mapobjects_store",
                                        "mission_client", "executor", "ground_port"};

} // namespace godwit::drill
