#include "actors/domain/mission/convert/plan_vehicle.hpp"

#include <algorithm>
#include <iterator>

namespace godwit::mission {

namespace {

struct type_row {
  std::int64_t type;
  vehicle_profile of_ardupilot;
  vehicle_profile of_px4;
};

using enum vehicle_profile;

// Of each class the first one is written.
constexpr type_row types[] = {
    {1, arduplane, px4_fixed_wing},    {2, arducopter, px4_multicopter},  {13, arducopter, px4_multicopter},
    {14, arducopter, px4_multicopter}, {15, arducopter, px4_multicopter}, {10, ardurover, px4_rover},
    {20, quadplane, px4_vtol},         {19, quadplane, px4_vtol},         {21, quadplane, px4_vtol},
    {22, quadplane, px4_vtol},
};

} // namespace

std::optional<vehicle_profile> profile_of(const plan_vehicle& named) {
  const auto* const found = std::ranges::find(types, named.type, &type_row::type);
  if (found == std::end(types) || (named.autopilot != ardupilot_firmware && named.autopilot != px4_firmware))
    return std::nullopt;
  return named.autopilot == ardupilot_firmware ? found->of_ardupilot : found->of_px4;
}

plan_vehicle plan_vehicle_of(vehicle_profile profile) {
  const auto* const found =
      std::ranges::find(types, profile, is_px4(profile) ? &type_row::of_px4 : &type_row::of_ardupilot);
  return {is_px4(profile) ? px4_firmware : ardupilot_firmware, found->type}; // the table has all of them
}

} // namespace godwit::mission
