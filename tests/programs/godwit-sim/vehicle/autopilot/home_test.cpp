// Where home is: what arming, people and missions make of it.
#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace home_test {

constexpr float force = 21'196;

// Up, 60 m to the north, down again and disarmed. Armed there anew, or not.
class moved_vehicle : public vehicle_world {
public:
  explicit moved_vehicle(personality who) : vehicle_world(who) {
    plan items = flight_of(4, home(), who);
    EXPECT_EQ(upload(items), mav_mission_result::accepted);
    EXPECT_TRUE(make_ready());
    EXPECT_EQ(command(mav_cmd::mission_start), mav_result::accepted);
    EXPECT_TRUE(run_until([&] { return picture().in_air; }, 60 * s));
    EXPECT_TRUE(run_until([&] { return !picture().armed; }, 300 * s));
  }
  [[nodiscard]] position told_home() {
    static_cast<void>(command(mav_cmd::request_message, {.p1 = mavlink::home_position::message_id}));
    run_for(1 * s);
    const auto m = *last<mavlink::home_position>();
    return {m.latitude / 1e7, m.longitude / 1e7, m.altitude / 1e3};
  }
  [[nodiscard]] double home_moved_m() { return between(told_home(), home()).distance_m; }
  [[nodiscard]] bool is_home_here() { return between(told_home(), picture().where).distance_m < 0.1; }
};

TEST(home, is_where_a_copter_or_a_plane_is_armed_again_also_as_item_0) {
  for (const auto who : {personality::ardupilot, personality::plane}) {
    moved_vehicle world(who);
    EXPECT_LT(world.home_moved_m(), 0.1) << "landing alone moves nothing";
    if (who == personality::plane) {
      ASSERT_EQ(world.command(mav_cmd::do_set_mode, {.p1 = 1, .p2 = 5}), mav_result::accepted);
    }
    ASSERT_TRUE(world.make_ready());
    EXPECT_GT(world.home_moved_m(), 40);
    EXPECT_TRUE(world.is_home_here());
    const auto items = world.download();
    ASSERT_TRUE(items);
    EXPECT_NEAR(items->front().x, world.told_home().latitude_deg * 1e7, 1);
  }
}

TEST(home, is_told_by_an_ardupilot_as_arming_moves_it) {
  moved_vehicle world(personality::ardupilot);
  world.mark();
  ASSERT_TRUE(world.make_ready());
  EXPECT_EQ(world.each<mavlink::home_position>().size(), 1U);
}

TEST(home, stays_in_the_middle_of_a_px4s_mission_and_moves_after_its_end) {
  moved_vehicle world(personality::px4);
  EXPECT_LT(world.home_moved_m(), 0.1);
  ASSERT_TRUE(world.make_ready());
  EXPECT_TRUE(world.is_home_here()) << "the mission is complete";
  vehicle_world other(personality::px4);
  ASSERT_EQ(other.upload(flight_of(4, other.home(), personality::px4)), mav_mission_result::accepted);
  ASSERT_EQ(other.command(mav_cmd::mission_start), mav_result::accepted);
  ASSERT_TRUE(other.run_until([&] { return other.picture().mission_current == 3; }, 100 * s));
  ASSERT_EQ(other.command(mav_cmd::component_arm_disarm, {.p1 = 0, .p2 = force}), mav_result::accepted);
  ASSERT_TRUE(other.run_until([&] { return !other.picture().in_air; }, 30 * s));
  ASSERT_TRUE(other.make_ready());
  other.run_for(3 * s);
  EXPECT_NEAR(other.last<mavlink::home_position>()->latitude, other.home().latitude_deg * 1e7, 1);
}

TEST(home, that_a_command_has_set_is_not_moved_by_arming) {
  moved_vehicle world(personality::ardupilot);
  const auto there = item_at(mav_cmd::do_set_home, world.home(), {100, 0, 0});
  ASSERT_EQ(world.command_int(mav_cmd::do_set_home, {.frame = 0, .x = there.x, .y = there.y, .z = 500}),
            mav_result::accepted);
  ASSERT_TRUE(world.make_ready());
  EXPECT_NEAR(world.home_moved_m(), 100, 0.1);
}

TEST(home, of_a_px4_is_free_again_when_it_was_set_to_where_it_is) {
  moved_vehicle world(personality::px4);
  ASSERT_EQ(world.command(mav_cmd::nav_loiter_unlim), mav_result::accepted); // else arming begins the mission anew
  const auto there = item_at(mav_cmd::do_set_home, world.home(), {100, 0, 0});
  ASSERT_EQ(world.command_int(mav_cmd::do_set_home, {.frame = 0, .x = there.x, .y = there.y, .z = 500}),
            mav_result::accepted);
  ASSERT_TRUE(world.make_ready());
  EXPECT_NEAR(world.home_moved_m(), 100, 0.1);
  ASSERT_EQ(world.command(mav_cmd::component_arm_disarm), mav_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::do_set_home, {.p1 = 1}), mav_result::accepted);
  ASSERT_TRUE(world.make_ready());
  EXPECT_TRUE(world.is_home_here());
}

TEST(home, of_the_rover_is_where_it_was_made) {
  vehicle_world world(personality::rover);
  ASSERT_EQ(world.upload(row_of(4, world.home())), mav_mission_result::accepted);
  ASSERT_TRUE(world.make_ready());
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  world.run_for(20 * s);
  ASSERT_EQ(world.command(mav_cmd::component_arm_disarm), mav_result::accepted);
  ASSERT_TRUE(world.make_ready());
  world.run_for(3 * s);
  EXPECT_NEAR(world.last<mavlink::home_position>()->latitude, world.home().latitude_deg * 1e7, 1);
}

} // namespace home_test
} // namespace godwit::sim::test
