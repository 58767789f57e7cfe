// The proof that the vehicle holds the plan that godwit has brought to it: what is asked of the vehicle, and how its
// answer is compared.
//
// A PX4 names its plan by an id, which MISSION_COUNT has; of any other vehicle all items are read and compared by
// meaning, without the home in front. What remains: another plan that is brought between the answer and the order.
// Pure. Thread: any. Source: MAVLink mission protocol; MISSION_COUNT (44) opaque_id.
#pragma once

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/executor/state.hpp"
#include "messages/vehicle_link/transfer.hpp"

namespace godwit::executor {

[[nodiscard]] vehicle_link::download_plan proof_request(const progress::followed_plan& plan);

// READ was accepted, and there is a plan that is flown.
[[nodiscard]] bool holds_flown_plan(const state& s, const vehicle_link::transfer::outcome& read,
                                    const flight::mode_owner& whose);

} // namespace godwit::executor
