#include "programs/godwit-sim/vehicle/autopilot/rover.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace ardu_rover_test {

// A rover with its waypoints, and its estimator ready.
class ardurover_with : public vehicle_world {
public:
  explicit ardurover_with(int waypoints) : vehicle_world(personality::ardurover) {
    auto items = row_of(waypoints, home());
    items.insert(items.begin(), items.front()); // home, which is replaced
    for (std::size_t i = 0; i < items.size(); ++i)
      items[i].seq = static_cast<std::uint16_t>(i);
    EXPECT_EQ(upload(items), mav_mission_result::accepted);
    run_for(8 * s);
    mark();
  }
  std::optional<mav_result> arm() { return command(mav_cmd::component_arm_disarm, {.p1 = 1}); }
  std::optional<mav_result> mode(float custom) { return command(mav_cmd::do_set_mode, {.p1 = 1, .p2 = custom}); }
};

// captures/rover_end.tlog, ardurover_mission.tlog.
TEST(ardu_rover, stays_armed_in_auto_after_its_last_item_and_says_that_its_mission_is_complete) {
  ardurover_with world(2);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_state == "completed"; }, 200 * s));
  world.run_for(30 * s);
  EXPECT_TRUE(world.picture().armed);
  EXPECT_EQ(world.picture().mode, "AUTO");
  EXPECT_EQ(world.last<mavlink::mission_item_reached>()->seq, 2);
  EXPECT_EQ(world.last<mavlink::mission_current>()->mission_state, mavlink::number(mavlink::mission_state::complete));
  EXPECT_EQ(world.last<mavlink::heartbeat>()->base_mode, 137);
}

TEST(ardu_rover, drives_off_when_it_is_armed_in_auto) {
  ardurover_with world(2);
  ASSERT_EQ(world.mode(10), mav_result::accepted);
  ASSERT_EQ(world.arm(), mav_result::accepted);
  EXPECT_TRUE(world.run_until([&] { return world.picture().ground_speed_mps > 0.5; }, 10 * s));
}

} // namespace ardu_rover_test
} // namespace godwit::sim::test
