// What kind of vehicle it is, as far as godwit has to tell them apart: what lands when it has no power left, what must
// go on flying, and what can simply stop. Thread: plain values, pure.
#pragma once

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums/vehicle.hpp"

namespace godwit::flight {

enum class vehicle_class { unknown, multirotor, fixed_wing, rover };

GODWIT_ENUM_NAMES(vehicle_class, unknown, multirotor, fixed_wing, rover);

// A vertical take-off aeroplane counts as an aeroplane: it comes home on its wings. A number that has no name here is
// possible, because the type comes from the air; it is unknown.
[[nodiscard]] constexpr vehicle_class class_of(io::mavlink::mav_type type) {
  using io::mavlink::mav_type;
  switch (type) {
  case mav_type::quadrotor:
  case mav_type::coaxial:
  case mav_type::helicopter:
  case mav_type::hexarotor:
  case mav_type::octorotor:
  case mav_type::tricopter:
    return vehicle_class::multirotor;
  case mav_type::fixed_wing:
  case mav_type::vtol_tailsitter_duorotor:
  case mav_type::vtol_tailsitter_quadrotor:
  case mav_type::vtol_tiltrotor:
  case mav_type::vtol_fixedrotor:
    return vehicle_class::fixed_wing;
  case mav_type::ground_rover:
  case mav_type::surface_boat:
    return vehicle_class::rover;
  case mav_type::generic:
  case mav_type::antenna_tracker:
  case mav_type::gcs:
  case mav_type::submarine:
  case mav_type::onboard_controller:
    break;
  }
  return vehicle_class::unknown;
}

} // namespace godwit::flight
