// What a failsafe has to know of the vehicle: what it is, what its mode comes down to, and whether it stands.
//
// Every autopilot numbers its modes in its own way. Whoever reads the heartbeat says what a number comes down to; the
// number itself is kept too, because a change between two modes of one kind is a change all the same. Thread: plain
// values.
#pragma once

#include <cstdint>

#include "io/fields/field_table.hpp"
#include "messages/flight/flight_mode.hpp"
#include "messages/flight/vehicle_class.hpp"

namespace godwit::failsafe {

using flight::flight_mode;
using flight::mode_kind;
using flight::vehicle_class;

// As EXTENDED_SYS_STATE says it.
enum class landed_state { unknown, on_ground, in_air, taking_off, landing };

} // namespace godwit::failsafe
