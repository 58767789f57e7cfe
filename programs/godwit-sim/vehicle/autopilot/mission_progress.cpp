#include "programs/godwit-sim/vehicle/autopilot/mission_progress.hpp"

namespace godwit::sim {

mavlink::mission_current place_in_mission(const mission_run& run, const plans::server& held,
                                          const traits& vehicle_traits) {
  const auto id_of = [&](mavlink::mav_mission_type type) {
    return vehicle_traits.plan_profile.has_plan_ids ? held.plan(type).id : 0U;
  };
  const int home = vehicle_traits.plan_profile.home ? 1 : 0; // is an item, and is not counted
  return {.seq = static_cast<std::uint16_t>(run.is_empty() ? 0 : run.current()),
          .total = run.is_empty() ? vehicle_traits.total_of_no_mission : static_cast<std::uint16_t>(run.count() - home),
          .mission_id = id_of(mavlink::mav_mission_type::mission),
          .fence_id = id_of(mavlink::mav_mission_type::fence),
          .rally_points_id = id_of(mavlink::mav_mission_type::rally)};
}

mavlink::mission_current progress_of(const mission_run& run, const plans::server& held, const traits& vehicle_traits,
                                     bool is_in_mission_mode) {
  auto m = place_in_mission(run, held, vehicle_traits);
  m.mission_mode =
      mavlink::number(is_in_mission_mode ? mavlink::mission_mode::active : mavlink::mission_mode::suspended);
  auto how = mavlink::mission_state::not_started;
  if (run.is_empty())
    how = mavlink::mission_state::no_mission;
  else if (run.state() == run_state::completed)
    how = mavlink::mission_state::complete;
  else if (run.state() == run_state::running)
    how = is_in_mission_mode ? mavlink::mission_state::active : mavlink::mission_state::paused;
  m.mission_state = mavlink::number(how);
  return m;
}

} // namespace godwit::sim
