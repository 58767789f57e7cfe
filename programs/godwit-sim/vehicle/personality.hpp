// Which autopilot a simulated vehicle behaves as. Thread: values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::sim {

// rover: nobody's product, by MAVLink's text; ardupilot: its Copter; ardurover: its Rover; quadplane: its Plane with
// rotors; px4_vtol: PX4's standard VTOL.
enum class personality { rover, px4, ardupilot, plane, ardurover, quadplane, px4_vtol };

[[nodiscard]] constexpr bool drives(personality who) {
  return who == personality::rover || who == personality::ardurover;
}

GODWIT_ENUM_NAMES(personality, rover, px4, ardupilot, plane, ardurover, quadplane, px4_vtol);

} // namespace godwit::sim
