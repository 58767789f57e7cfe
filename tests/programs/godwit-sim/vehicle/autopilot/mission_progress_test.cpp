#include "programs/godwit-sim/vehicle/autopilot/mission_progress.hpp"

#include <gtest/gtest.h>

namespace godwit::sim {
namespace mission_progress_test {

std::vector<mavlink::mission_item_int> waypoints(int count) {
  mavlink::mission_item_int item{.frame = 3, .command = mavlink::number(mavlink::mav_cmd::nav_waypoint)};
  return {static_cast<std::size_t>(count), item};
}

struct loaded {
  loaded(personality who, int count) : vehicle_traits(traits_of(who)), held(vehicle_traits.plan_profile, {1, 1}) {
    held.put_plan(mavlink::mav_mission_type::mission, waypoints(count));
    run.load(held.plan(mavlink::mav_mission_type::mission).items, vehicle_traits.plan_profile.home ? 1 : 0);
  }
  const traits& vehicle_traits;
  plans::server held;
  mission_run run;
};

mavlink::mission_current progress_with(personality who, int count) {
  const loaded vehicle(who, count);
  return place_in_mission(vehicle.run, vehicle.held, vehicle.vehicle_traits);
}

TEST(mission_progress, counts_all_items_but_home) {
  EXPECT_EQ(progress_with(personality::px4, 5).total, 5);
  EXPECT_EQ(progress_with(personality::rover, 5).total, 5);
  EXPECT_EQ(progress_with(personality::ardupilot, 5).total, 4);
}

TEST(mission_progress, of_no_mission_is_65535_items_or_none) {
  EXPECT_EQ(progress_with(personality::px4, 0).total, 65535);
  EXPECT_EQ(progress_with(personality::rover, 0).total, 65535);
  EXPECT_EQ(progress_with(personality::ardupilot, 0).total, 0);
}

TEST(mission_progress, names_the_plan_where_plans_have_ids) {
  EXPECT_NE(progress_with(personality::px4, 5).mission_id, 0U);
  EXPECT_EQ(progress_with(personality::ardupilot, 5).mission_id, 0U);
  EXPECT_EQ(progress_with(personality::px4, 5).fence_id, 0U);
}

TEST(mission_progress, tells_whether_there_is_a_mission_and_whether_its_mode_flies) {
  const auto told = [](int count, bool is_in_mission_mode) {
    const loaded vehicle(personality::px4, count);
    return progress_of(vehicle.run, vehicle.held, vehicle.vehicle_traits, is_in_mission_mode);
  };
  EXPECT_EQ(told(0, true).mission_state, mavlink::number(mavlink::mission_state::no_mission));
  EXPECT_EQ(told(5, true).mission_state, mavlink::number(mavlink::mission_state::not_started));
  EXPECT_EQ(told(5, true).mission_mode, mavlink::number(mavlink::mission_mode::active));
  EXPECT_EQ(told(5, false).mission_mode, mavlink::number(mavlink::mission_mode::suspended));
}

} // namespace mission_progress_test
} // namespace godwit::sim
