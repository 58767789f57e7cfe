// How a change of mode is told, besides the HEARTBEAT of each second.
#include <gtest/gtest.h>

#include "io/mavlink/messages/heartbeat.hpp"
#include "programs/godwit-sim/vehicle/autopilot/mode_table.hpp"
#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace mode_news_test {

void expect_told(const vehicle_world& world, std::uint32_t actual, std::uint32_t intended) {
  const auto told = world.each<mavlink::current_mode>();
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().custom_mode, actual);
  EXPECT_EQ(told.back().intended_custom_mode, intended);
}

TEST(mode_news, a_copter_and_a_plane_send_a_heartbeat_at_once_at_each_change_and_others_do_not) {
  for (const auto who : {personality::ardupilot, personality::plane, personality::px4, personality::rover}) {
    vehicle_world world(who);
    const bool beats = who == personality::ardupilot || who == personality::plane;
    world.run_for(500 * ms);
    world.mark();
    static_cast<void>(world.command(mav_cmd::nav_return_to_launch));
    const auto heard = world.each<mavlink::heartbeat>();
    ASSERT_EQ(heard.size(), beats ? 1U : 0U) << io::name_of(who);
    if (beats) {
      EXPECT_EQ(heard.front().custom_mode, who == personality::plane ? 11U : 6U);
    }
  }
}

// As recorded: each 2 s unasked, and not at a change of the mode.
TEST(mode_news, a_px4_tells_the_mode_that_it_is_in_and_the_intended_one_as_often_as_it_is_asked_to) {
  vehicle_world world(personality::px4);
  world.run_for(3 * s);
  constexpr auto loiter = px4_mode(4, 3);
  constexpr auto rtl = px4_mode(4, 5);
  expect_told(world, loiter, loiter);
  world.mark();
  ASSERT_EQ(world.command(mav_cmd::nav_return_to_launch), mav_result::accepted);
  EXPECT_TRUE(world.each<mavlink::current_mode>().empty()) << "it tells at its time";
  world.run_for(2 * s);
  expect_told(world, rtl, rtl);
  ASSERT_EQ(world.command(mav_cmd::set_message_interval, {.p1 = 436, .p2 = 500'000}), mav_result::accepted);
  world.mark();
  world.run_for(4 * s);
  EXPECT_NEAR(static_cast<double>(world.each<mavlink::current_mode>().size()), 8, 1);
}

TEST(mode_news, what_a_px4_does_by_itself_for_safety_changes_the_actual_mode_alone) {
  vehicle_world world(personality::px4);
  ASSERT_EQ(world.upload(flight_of(3, world.home(), personality::px4)), mav_mission_result::accepted);
  ASSERT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
  ASSERT_TRUE(world.run_until([&] { return world.picture().mission_current == 2; }, 60 * s));
  world.subject().lose_position(true, world.now_ns());
  world.run_for(2 * s);
  expect_told(world, px4_mode(4, 6), px4_mode(4, 4));
}

} // namespace mode_news_test
} // namespace godwit::sim::test
