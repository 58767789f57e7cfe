// The kinds of vehicles that answer differently to the items of a mission. Thread: constants.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::mission {

enum class vehicle_profile {
  arducopter,
  arduplane,
  quadplane, // ArduPilot
  ardurover,
  px4_multicopter,
  px4_vtol,
  px4_fixed_wing,
  px4_rover
};

constexpr auto enum_names(vehicle_profile) {
  return io::names<vehicle_profile>({{vehicle_profile::arducopter, "arducopter"},
                                     {vehicle_profile::arduplane, "arduplane"},
                                     {vehicle_profile::quadplane, "quadplane"},
                                     {vehicle_profile::ardurover, "ardurover"},
                                     {vehicle_profile::px4_multicopter, "px4-multicopter"},
                                     {vehicle_profile::px4_vtol, "px4-vtol"},
                                     {vehicle_profile::px4_fixed_wing, "px4-fixed-wing"},
                                     {vehicle_profile::px4_rover, "px4-rover"}});
}

[[nodiscard]] constexpr bool is_px4(vehicle_profile each) { return each >= vehicle_profile::px4_multicopter; }

} // namespace godwit::mission
