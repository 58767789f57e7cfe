// A quadplane and PX4's standard VTOL, as stations see them.
#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace vtol_test {

constexpr int on_rotors = 3;
constexpr int on_wings = 4;

// Up, two waypoints, down at home.
plan there_and_back(const vehicle_world& world, personality who) {
  plan items{item_at(mav_cmd::nav_vtol_takeoff, world.home(), {0, 0, 30}),
             item_at(mav_cmd::nav_waypoint, world.home(), {500, 0, 40}),
             item_at(mav_cmd::nav_waypoint, world.home(), {500, 300, 40}),
             item_at(mav_cmd::nav_vtol_land, world.home(), {0, 0, 0})};
  if (who == personality::quadplane)
    items.insert(items.begin(), item_at(mav_cmd::nav_waypoint, world.home(), {}));
  return numbered(items);
}

struct vtol : testing::TestWithParam<personality> {
  vehicle_world world{GetParam()};

  void take_off() {
    world.run_for(8 * s);
    ASSERT_EQ(world.upload(there_and_back(world, GetParam())), mav_mission_result::accepted);
    world.run_for(2 * s);
    if (GetParam() == personality::quadplane) {
      ASSERT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::accepted);
    }
    ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
    constexpr float each_us = 200'000;
    ASSERT_EQ(
        world.command(mav_cmd::set_message_interval, {.p1 = mavlink::extended_sys_state::message_id, .p2 = each_us}),
        mav_result::accepted);
    world.mark();
  }
  [[nodiscard]] int state() const { return world.last<mavlink::extended_sys_state>()->vtol_state; }
};

TEST_P(vtol, flies_its_mission_on_rotors_and_wings_and_disarms_where_it_has_landed) {
  take_off();
  const int last = GetParam() == personality::quadplane ? 4 : 3;
  ASSERT_TRUE(world.run_until([&] { return world.picture().in_air; }, 60 * s));
  world.run_for(2 * s);
  EXPECT_EQ(state(), on_rotors);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_current == last; }, 200 * s));
  world.run_for(s);
  EXPECT_EQ(state(), on_wings);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 200 * s));
  EXPECT_LT(between(world.picture().where, world.home()).distance_m, 3);
  EXPECT_EQ(state(), on_rotors);
}

TEST_P(vtol, calls_itself_what_it_calls_itself) {
  world.run_for(8 * s);
  const auto type =
      GetParam() == personality::quadplane ? mavlink::mav_type::fixed_wing : mavlink::mav_type::vtol_fixedrotor;
  EXPECT_EQ(world.last<mavlink::heartbeat>()->type, mavlink::number(type));
}

INSTANTIATE_TEST_SUITE_P(both, vtol, testing::Values(personality::quadplane, personality::px4_vtol),
                         [](const auto& each) { return std::string(io::name_of(each.param)); });

TEST(quadplane, stands_on_the_item_of_its_landing_without_a_word_of_completion) {
  vehicle_world world(personality::quadplane);
  world.run_for(8 * s);
  ASSERT_EQ(world.upload(there_and_back(world, personality::quadplane)), mav_mission_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 400 * s));
  world.run_for(3 * s);
  EXPECT_EQ(world.picture().mode, "AUTO");
  EXPECT_EQ(world.last<mavlink::mission_current>()->seq, 4);
  EXPECT_EQ(world.last<mavlink::mission_current>()->mission_state, 3);
}

TEST(quadplane, comes_down_on_its_rotors_in_qland) {
  vehicle_world world(personality::quadplane);
  world.run_for(8 * s);
  ASSERT_EQ(world.upload(there_and_back(world, personality::quadplane)), mav_mission_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_current == 3; }, 200 * s));
  ASSERT_EQ(world.command(mav_cmd::do_set_mode, {.p1 = 1, .p2 = 20}), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 120 * s));
  EXPECT_FALSE(world.picture().in_air);
}

} // namespace vtol_test
} // namespace godwit::sim::test
