// Commands that all personalities take alike.
#include <array>

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace orders_test {

constexpr std::array all_personalities{personality::rover, personality::px4, personality::ardupilot};

TEST(orders, an_unknown_command_is_unsupported) {
  for (const auto who : all_personalities)
    EXPECT_EQ(vehicle_world(who).command(31'999), mav_result::unsupported);
}

TEST(orders, disarming_what_is_disarmed_is_accepted) {
  for (const auto who : all_personalities)
    EXPECT_EQ(vehicle_world(who).command(mav_cmd::component_arm_disarm), mav_result::accepted);
}

TEST(orders, arming_by_another_number_than_0_or_1_is_denied) {
  for (const auto who : all_personalities)
    EXPECT_EQ(vehicle_world(who).command(mav_cmd::component_arm_disarm, {.p1 = 0.5F}), mav_result::denied);
}

TEST(orders, a_forced_arming_does_not_look_at_the_position) {
  for (const auto who : all_personalities) {
    vehicle_world world(who);
    world.subject().lose_position(true, world.now_ns());
    EXPECT_NE(world.command(mav_cmd::component_arm_disarm, {.p1 = 1}), mav_result::accepted);
    EXPECT_EQ(world.command(mav_cmd::component_arm_disarm, {.p1 = 1, .p2 = 21196}), mav_result::accepted);
  }
}

TEST(orders, do_set_mode_without_the_custom_bit_is_denied) {
  for (const auto who : all_personalities)
    EXPECT_EQ(vehicle_world(who).command(mav_cmd::do_set_mode, {.p1 = 0, .p2 = 4}), mav_result::denied);
}

TEST(orders, home_is_moved_and_told) {
  vehicle_world world(personality::px4);
  const auto there = item_at(mav_cmd::do_set_home, world.home(), {100, 0, 0});
  ASSERT_EQ(world.command_int(mav_cmd::do_set_home, {.frame = 0, .x = there.x, .y = there.y, .z = 500}),
            mav_result::accepted);
  EXPECT_EQ(world.last<mavlink::home_position>()->latitude, there.x);
  EXPECT_EQ(world.last<mavlink::home_position>()->altitude, 500'000);
}

TEST(orders, a_speed_is_taken_if_it_is_one) {
  for (const auto who : all_personalities) {
    vehicle_world world(who);
    EXPECT_EQ(world.command(mav_cmd::do_change_speed, {.p1 = 1, .p2 = 3}), mav_result::accepted);
    EXPECT_EQ(world.command(mav_cmd::do_change_speed, {.p1 = 1, .p2 = -1}), mav_result::accepted);
    EXPECT_EQ(world.command(mav_cmd::do_change_speed, {.p1 = 1, .p2 = 0}), mav_result::denied);
  }
}

TEST(orders, start_again_on_the_ground_when_asked_with_1) {
  for (const auto who : all_personalities) {
    vehicle_world world(who);
    world.run_for(10 * s);
    ASSERT_EQ(world.command(246, {.p1 = 1}), mav_result::accepted);
    world.run_for(5 * s);
    EXPECT_LT(world.picture().world_ms, 3'000);
  }
}

} // namespace orders_test
} // namespace godwit::sim::test
