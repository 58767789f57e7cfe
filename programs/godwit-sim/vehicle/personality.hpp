// Which autopilot a simulated vehicle behaves as. Thread: values.
#pragma once

#include "io/fields/field_table.hpp"

namespace godwit::sim {

enum class personality { rover, px4, ardupilot, plane }; // ardupilot: its Copter

constexpr auto enum_names(personality) {
  return io::names<personality>({{personality::rover, "rover"},
                                 {personality::px4, "px4"},
                                 {personality::ardupilot, "ardupilot"},
                                 {personality::plane, "plane"}});
}

} // namespace godwit::sim
