#include "programs/godwit-sim/vehicle/autopilot/mission_progress.hpp"

#include <gtest/gtest.h>

namespace godwit::sim {
namespace {

std::vector<mavlink::mission_item_int> waypoints(int count) {
  mavlink::mission_item_int item{.frame = 3, .command = mavlink::number(mavlink::mav_cmd::nav_waypoint)};
  return {static_cast<std::size_t>(count), item};
}

mavlink::mission_current progress_with(personality who, int count) {
  const auto& habits = traits_of(who);
  plans::server held(habits.plan_habits, {1, 1});
  held.put_plan(mavlink::mav_mission_type::mission, waypoints(count));
  mission_run run;
  run.load(held.plan(mavlink::mav_mission_type::mission).items, habits.plan_habits.home ? 1 : 0);
  return progress_of(run, held, habits);
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

} // namespace
} // namespace godwit::sim
