// Facts with which every check passes or, like that of the operator, is skipped. Thread: pure.
#pragma once

#include <string>

#include "actors/executor/preflight/checks.hpp"
#include "actors/executor/preflight/report.hpp"
#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::preflight::test {

inline constexpr std::int64_t ns_per_s = 1'000'000'000;
inline constexpr std::int64_t in_2026_ns = 1'780'000'000 * ns_per_s;

// Up, 100 m to the east, back, within a fence.
inline const mission::document& small_mission() {
  static const auto made = [] {
    auto result = plan::mission_of(
        {mission::takeoff{"up", 30}, plan::waypoint("east", plan::at(100, 0, 30)), mission::return_home{"back"}});
    result.revision = 4;
    result.planned_home = mission::planned_home{result.return_point->latitude, result.return_point->longitude, {}};
    result.geofences = {tests::inclusion(tests::box(-50, -50, 150, 50))};
    return result;
  }();
  return made;
}

inline const plan_result& small_plans() {
  static const plan_result made = plan::build_plans(small_mission(), plan::px4_copter);
  return made;
}

inline facts good_facts() {
  facts all;
  all.vehicle = {.link = vehicle_link::connection_phase::connected,
                 .link_reason = {},
                 .what = flight::vehicle_class::multirotor,
                 .autopilot = io::mavlink::mav_autopilot::px4,
                 .fix = io::mavlink::gps_fix_type::fix_3d,
                 .satellites = 10,
                 .position_age_ns = 100'000'000,
                 .is_home_known = true,
                 .battery_percent = 83,
                 .own = own_checks::passing,
                 .estimate = estimate::ready,
                 .why_not_armed = {}};
  all.mission.document = &small_mission();
  all.mission.plans = &small_plans();
  all.mission.way.emplace();
  all.mission.return_point.emplace();
  all.mission.out_of_limits.emplace();
  all.mission.planned_home.emplace();
  all.mission.spare_percent = 20;
  all.mission.straight_return.emplace();
  all.mission.map = mission_client::pull_state::synced;
  all.journal = {true, true, false, 8'000'000'000};
  all.wall_ns = in_2026_ns;
  all.actors = {{"vehicle_link", true}, {"failsafe", true}};
  all.camera = {camera_state::ready, {}};
  all.traffic.heard = {"SWR123, 9 km to the north"};
  return all;
}

inline bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

} // namespace godwit::executor::preflight::test
