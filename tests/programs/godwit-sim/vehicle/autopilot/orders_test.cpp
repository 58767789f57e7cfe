// Commands that all personalities take alike.
#include <array>
#include <cstring>

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

// Commands that ask for messages.

namespace message_orders_test {

constexpr std::array every_personality{personality::rover, personality::px4, personality::ardupilot};
constexpr float nobody_knows = 99'999;

TEST(message_orders, versions_and_home_are_given_when_asked_for) {
  for (const auto who : every_personality) {
    vehicle_world world(who);
    EXPECT_EQ(world.command(mav_cmd::request_message, {.p1 = 148}), mav_result::accepted);
    EXPECT_EQ(world.each<mavlink::autopilot_version>().size(), 1U);
    EXPECT_EQ(world.command(520, {.p1 = 1}), mav_result::accepted);
    EXPECT_EQ(world.each<mavlink::autopilot_version>().size(), 2U);
    world.mark();
    EXPECT_EQ(world.command(mav_cmd::request_message, {.p1 = 242}), mav_result::accepted);
    EXPECT_EQ(world.command(410), mav_result::accepted);
    EXPECT_EQ(world.each<mavlink::home_position>().size(), 2U);
  }
}

TEST(message_orders, the_protocol_version_is_given_by_all_but_ardupilot) {
  for (const auto who : every_personality) {
    vehicle_world world(who);
    const bool is_told = who != personality::ardupilot;
    EXPECT_EQ(world.command(519, {.p1 = 1}), is_told ? mav_result::accepted : mav_result::unsupported);
    EXPECT_EQ(world.command(mav_cmd::request_message, {.p1 = 300}),
              is_told ? mav_result::accepted : mav_result::failed);
    EXPECT_EQ(world.each<mavlink::protocol_version>().size(), is_told ? 2U : 0U);
  }
}

TEST(message_orders, capabilities_are_those_of_the_autopilot) {
  const auto capabilities = [](personality who) {
    vehicle_world world(who);
    EXPECT_EQ(world.command(mav_cmd::request_message, {.p1 = 148}), mav_result::accepted);
    return world.last<mavlink::autopilot_version>()->capabilities;
  };
  EXPECT_EQ(capabilities(personality::px4), 59'647U);
  EXPECT_EQ(capabilities(personality::ardupilot), 61'935U);
  constexpr std::uint64_t mission_int_and_mavlink_2 = 4 | 8192;
  EXPECT_EQ(capabilities(personality::rover) & mission_int_and_mavlink_2, mission_int_and_mavlink_2);
}

TEST(message_orders, an_unknown_message_is_refused_as_the_autopilot_does) {
  const auto asked = [](personality who) {
    return vehicle_world(who).command(mav_cmd::request_message, {.p1 = nobody_knows});
  };
  EXPECT_EQ(asked(personality::rover), mav_result::denied);
  EXPECT_EQ(asked(personality::px4), mav_result::denied);
  EXPECT_EQ(asked(personality::ardupilot), mav_result::failed);
}

TEST(message_orders, an_interval_of_an_unknown_message_is_refused_as_the_autopilot_does) {
  const auto asked = [](personality who) {
    return vehicle_world(who).command(mav_cmd::set_message_interval, {.p1 = nobody_knows, .p2 = 1e6F});
  };
  EXPECT_EQ(asked(personality::rover), mav_result::denied);
  EXPECT_EQ(asked(personality::px4), mav_result::failed);
  EXPECT_EQ(asked(personality::ardupilot), mav_result::denied);
}

TEST(message_orders, an_interval_is_set_stopped_and_told) {
  for (const auto who : every_personality) {
    vehicle_world world(who);
    ASSERT_EQ(world.command(mav_cmd::set_message_interval, {.p1 = 245, .p2 = 100'000}), mav_result::accepted);
    world.run_for(5 * s);
    EXPECT_NEAR(static_cast<double>(world.each<mavlink::extended_sys_state>().size()), 50, 1);
    ASSERT_EQ(world.command(510, {.p1 = 245}), mav_result::accepted);
    constexpr std::uint32_t message_interval = 244;
    const auto told = std::find_if(world.all().rbegin(), world.all().rend(),
                                   [](const heard& each) { return each.id == message_interval; });
    ASSERT_NE(told, world.all().rend());
    std::int32_t interval_us = 0;
    std::memcpy(&interval_us, mavlink::frame_view(told->bytes.data()).payload().data(), sizeof interval_us);
    EXPECT_EQ(interval_us, 100'000);
    ASSERT_EQ(world.command(mav_cmd::set_message_interval, {.p1 = 245, .p2 = -1}), mav_result::accepted);
    world.mark();
    world.run_for(5 * s);
    EXPECT_TRUE(world.each<mavlink::extended_sys_state>().empty());
  }
}

} // namespace message_orders_test

} // namespace godwit::sim::test
