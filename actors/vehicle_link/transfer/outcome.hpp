// Sentences for what a vehicle says to a transfer; the outcome itself is in messages/vehicle_link/transfer.hpp.
#pragma once

#include <cstdint>
#include <string>

#include "messages/vehicle_link/transfer.hpp"

namespace godwit::vehicle_link::transfer {

// "the vehicle has no room for so many items", for a MAV_MISSION_RESULT.
[[nodiscard]] std::string sentence_for_mission_result(std::uint8_t result);

} // namespace godwit::vehicle_link::transfer
