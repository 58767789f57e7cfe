#include "programs/godwit-sim/vehicle/autopilot/plane.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace plane_test {

constexpr float automatic = 10;
constexpr float rtl = 11;
constexpr float plane_loiter = 12;
constexpr float take_off = 13;
constexpr float guided = 15;

// Home, a take-off, two waypoints; and what each test puts after them.
class plane_with : public vehicle_world {
public:
  explicit plane_with(const plan& rest = {}) : vehicle_world(personality::plane) {
    run_for(6 * s);
    plan items{item_at(mav_cmd::nav_waypoint, home(), {}), item_at(mav_cmd::nav_takeoff, home(), {0, 0, 40}),
               item_at(mav_cmd::nav_waypoint, home(), {300, 0, 40}),
               item_at(mav_cmd::nav_waypoint, home(), {300, 300, 40})};
    items.insert(items.end(), rest.begin(), rest.end());
    EXPECT_EQ(upload(numbered(items)), mav_mission_result::accepted);
    run_for(2 * s);
    mark();
  }
  std::optional<mav_result> mode(float custom) { return command(mav_cmd::do_set_mode, {.p1 = 1, .p2 = custom}); }
  std::optional<mav_result> arm() { return command(mav_cmd::component_arm_disarm, {.p1 = 1}); }
  std::optional<mav_result> start() { return command(mav_cmd::mission_start); }
  // In the air, on the way to item SEQUENCE.
  [[nodiscard]] bool fly_to(int sequence) {
    return arm() == mav_result::accepted && start() == mav_result::accepted &&
           run_until([&] { return picture().mission_current == sequence; }, 200 * s);
  }
  [[nodiscard]] double from_home_m() const { return between(picture().where, home()).distance_m; }
  [[nodiscard]] bool is_in(const std::string& wanted) const { return picture().mode == wanted; }
};

mavlink::mission_item_int land_at_home() { return item_at(mav_cmd::nav_land, vehicle_settings{}.home, {0, 0, 0}); }

TEST(plane, calls_itself_a_fixed_wing_of_ardupilot) {
  plane_with world;
  EXPECT_EQ(world.last<mavlink::heartbeat>()->type, mavlink::number(mavlink::mav_type::fixed_wing));
  EXPECT_EQ(world.last<mavlink::heartbeat>()->autopilot, mavlink::number(mavlink::mav_autopilot::ardupilotmega));
}

TEST(plane, changes_to_rtl_by_itself_after_a_last_waypoint_and_circles_over_home_for_ever) {
  plane_with world;
  ASSERT_TRUE(world.fly_to(3));
  ASSERT_TRUE(world.run_until([&] { return world.is_in("RTL"); }, 120 * s));
  EXPECT_EQ(world.reached(), (std::vector{1, 2, 3}));
  world.run_for(2 * s);
  EXPECT_EQ(world.last<mavlink::mission_current>()->mission_state, 5);
  world.run_for(300 * s);
  EXPECT_TRUE(world.picture().in_air);
  EXPECT_TRUE(world.picture().armed);
  EXPECT_NEAR(world.from_home_m(), 60, 5);
}

TEST(plane, shows_rtl_as_a_return_item_starts) {
  plane_with world({bare_item(mav_cmd::nav_return_to_launch)});
  ASSERT_TRUE(world.fly_to(4));
  EXPECT_TRUE(world.is_in("RTL"));
  EXPECT_GT(world.from_home_m(), 200) << "it begins there";
  world.run_for(100 * s);
  EXPECT_EQ(world.reached(), (std::vector{1, 2, 3})) << "nothing says that the return was reached";
}

TEST(plane, stands_on_its_landing_item_and_disarms_in_auto_20_s_later_without_a_word_of_completion) {
  plane_with world({item_at(mav_cmd::nav_waypoint, vehicle_settings{}.home, {600, 0, 40}), land_at_home()});
  ASSERT_TRUE(world.fly_to(5));
  ASSERT_TRUE(world.run_until([&] { return !world.picture().in_air; }, 120 * s));
  world.run_for(15 * s);
  EXPECT_TRUE(world.picture().armed);
  world.run_for(10 * s);
  EXPECT_FALSE(world.picture().armed);
  EXPECT_TRUE(world.is_in("AUTO"));
  EXPECT_EQ(world.last<mavlink::mission_current>()->seq, 5);
  EXPECT_EQ(world.last<mavlink::mission_current>()->mission_state, 3);
  EXPECT_EQ(world.reached(), (std::vector{1, 2, 3, 4}));
}

TEST(plane, takes_off_when_it_is_armed_in_auto) {
  plane_with world;
  EXPECT_EQ(world.mode(automatic), mav_result::accepted);
  EXPECT_EQ(world.arm(), mav_result::accepted);
  EXPECT_TRUE(world.run_until([&] { return world.picture().in_air; }, 20 * s));
}

TEST(plane, stays_on_the_ground_when_it_is_armed_in_auto_without_a_mission) {
  plane_with world;
  ASSERT_EQ(world.clear(), mav_mission_result::accepted);
  EXPECT_EQ(world.mode(automatic), mav_result::accepted);
  EXPECT_EQ(world.arm(), mav_result::accepted);
  world.run_for(30 * s);
  EXPECT_FALSE(world.picture().in_air);
}

TEST(plane, does_not_arm_in_rtl) {
  plane_with world;
  EXPECT_EQ(world.mode(rtl), mav_result::accepted);
  EXPECT_EQ(world.arm(), mav_result::failed);
  EXPECT_FALSE(world.picture().armed);
}

TEST(plane, takes_off_by_its_mode_alone_and_circles_up_there) {
  plane_with world;
  EXPECT_EQ(world.command(mav_cmd::nav_takeoff, {.p7 = 30}), mav_result::failed);
  EXPECT_EQ(world.mode(take_off), mav_result::accepted);
  EXPECT_EQ(world.arm(), mav_result::accepted);
  world.run_for(60 * s);
  EXPECT_NEAR(world.picture().where.altitude_m - world.home().altitude_m, 50, 4);
  EXPECT_EQ(world.picture().mode, "TAKEOFF");
}

TEST(plane, a_hold_is_loiter_and_circles) {
  plane_with world;
  ASSERT_TRUE(world.fly_to(2));
  world.run_for(5 * s);
  EXPECT_EQ(world.command(mav_cmd::nav_loiter_unlim), mav_result::accepted);
  EXPECT_TRUE(world.is_in("LOITER"));
  const auto there = world.picture().where;
  world.run_for(60 * s);
  EXPECT_NEAR(between(world.picture().where, there).distance_m, 60, 6);
  EXPECT_EQ(world.mode(automatic), mav_result::accepted) << "and goes on";
  EXPECT_TRUE(world.run_until([&] { return world.picture().mission_current == 3; }, 120 * s));
}

TEST(plane, circles_around_the_place_of_a_reposition_as_command_int) {
  plane_with world;
  ASSERT_TRUE(world.fly_to(2));
  const auto there = moved(world.home(), {90, 400});
  mavlink::command_int wanted;
  wanted.param2 = 1; // change mode
  wanted.frame = mavlink::number(mavlink::mav_frame::global_relative_alt);
  wanted.x = static_cast<std::int32_t>(there.latitude_deg * 1e7);
  wanted.y = static_cast<std::int32_t>(there.longitude_deg * 1e7);
  wanted.z = 80;
  EXPECT_EQ(world.command_int(mav_cmd::do_reposition, wanted), mav_result::accepted);
  EXPECT_TRUE(world.is_in("GUIDED"));
  world.run_for(90 * s);
  EXPECT_NEAR(between(world.picture().where, there).distance_m, 60, 6);
  EXPECT_NEAR(world.picture().where.altitude_m - world.home().altitude_m, 80, 3);
  EXPECT_EQ(world.mode(guided), mav_result::accepted);
}

TEST(plane, has_no_mode_for_landing_and_lands_by_the_landing_of_its_plan) {
  const auto lands = bare_item(mav_cmd::do_land_start);
  plane_with without;
  ASSERT_TRUE(without.fly_to(2));
  EXPECT_EQ(without.command(mav_cmd::nav_land), mav_result::unsupported);
  EXPECT_EQ(without.command(mav_cmd::do_land_start), mav_result::failed);
  plane_with world({lands, item_at(mav_cmd::nav_waypoint, vehicle_settings{}.home, {600, 0, 40}), land_at_home()});
  ASSERT_TRUE(world.fly_to(2));
  EXPECT_EQ(world.mode(plane_loiter), mav_result::accepted);
  EXPECT_EQ(world.command(mav_cmd::do_land_start), mav_result::accepted);
  EXPECT_TRUE(world.is_in("AUTO"));
  EXPECT_TRUE(world.run_until([&] { return !world.picture().in_air; }, 200 * s));
  EXPECT_LT(world.from_home_m(), 120);
}

TEST(plane, flies_on_without_satellites) {
  plane_with world;
  ASSERT_TRUE(world.fly_to(2));
  world.subject().lose_position(true, world.now_ns());
  world.run_for(5 * s);
  EXPECT_TRUE(world.is_in("AUTO"));
}

TEST(plane, with_an_empty_battery_comes_down_ahead_whatever_its_mode_and_disarms) {
  plane_with world;
  ASSERT_TRUE(world.fly_to(2));
  world.subject().set_battery(0, world.now_ns());
  world.run_for(5 * s);
  EXPECT_EQ(world.mode(plane_loiter), mav_result::accepted);
  EXPECT_TRUE(world.run_until([&] { return !world.picture().in_air; }, 60 * s));
  EXPECT_FALSE(world.picture().armed);
}

TEST(plane, disarming_elsewhere_than_in_auto_puts_the_mission_back_to_its_beginning) {
  plane_with world;
  ASSERT_TRUE(world.fly_to(3));
  EXPECT_EQ(world.mode(plane_loiter), mav_result::accepted);
  constexpr float force = 21'196;
  EXPECT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 0, .p2 = force}), mav_result::accepted);
  world.run_for(60 * s);
  EXPECT_FALSE(world.picture().in_air);
  EXPECT_EQ(world.last<mavlink::mission_current>()->seq, 0);
}

} // namespace plane_test
} // namespace godwit::sim::test
