#include "actors/executor/preflight/checks/position.hpp"

#include <string>

#include "io/time_units.hpp"

namespace godwit::executor::preflight {

namespace {

bool is_in_three_dimensions(io::mavlink::gps_fix_type fix) {
  using io::mavlink::gps_fix_type;
  switch (fix) {
  case gps_fix_type::fix_3d:
  case gps_fix_type::dgps:
  case gps_fix_type::rtk_float:
  case gps_fix_type::rtk_fixed:
  case gps_fix_type::ppp:
    return true;
  case gps_fix_type::no_gps:
  case gps_fix_type::no_fix:
  case gps_fix_type::fix_2d:
  case gps_fix_type::fixed_position:
    break;
  }
  return false;
}

} // namespace

result look_at_position(const facts& seen, const settings& set) {
  if (!is_vehicle_heard(seen))
    return skipped("The vehicle is not heard: where it is, is not known.");
  const auto& now = seen.vehicle;
  if (now.fix == io::mavlink::gps_fix_type::fixed_position)
    return fail("The vehicle's satellite receiver is set up as a base station; set it up for a vehicle.");
  if (!is_in_three_dimensions(now.fix))
    return fail("The vehicle has no position fix in three dimensions; wait for it under an open sky.");
  if (!now.position_age_ns || *now.position_age_ns > set.position_stale_ms * ns_per_ms)
    return fail("The vehicle reports no position, or an old one; wait until its position estimate is ready.");
  if (now.satellites && *now.satellites < set.min_satellites)
    return degraded("Fewer than " + std::to_string(set.min_satellites) +
                    " satellites are received; wait, or go where more of the sky is seen.");
  return pass("The position is known in three dimensions.");
}

} // namespace godwit::executor::preflight
