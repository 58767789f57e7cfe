// The core: sending.
#include <gtest/gtest.h>

#include "tests/actors/failsafe/flights.hpp"

namespace core_sending_test {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::mission::fence_kind;
using godwit::vehicle_link::command_verdict;

TEST(failsafe_core, sending_fails_again_each_tick_until_it_gets_through) {
  auto world = fenced();
  world.refuses = command_verdict::not_sent;
  world.east_m = 101;
  world.run_ms(2'200); // the second position outside comes after 200 ms
  EXPECT_EQ(world.sent.size(), 20U);
  EXPECT_EQ(world.health().how, godwit::runtime::health_colour::red);
  EXPECT_TRUE(world.has_warned_of("does not get through"));
  world.refuses.reset();
  world.run_s(10);
  EXPECT_EQ(world.obeyed.size(), 1U);
  EXPECT_EQ(world.health().how, godwit::runtime::health_colour::yellow);
}

TEST(failsafe_core, while_the_autopilot_is_not_heard_nothing_is_done) {
  auto world = fenced();
  world.sends_heartbeats = false;
  world.run_s(6);
  world.operator_there = false;
  world.east_m = 500;
  drain_to(world, 5);
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_core, when_the_autopilot_is_heard_again_its_mode_is_looked_at_first) {
  for (const bool autopilot_returned : {false, true}) {
    auto world = fenced();
    world.sends_heartbeats = false;
    world.run_s(6);
    world.east_m = 500;
    world.run_s(2);
    if (autopilot_returned)
      world.mode = in_return;
    world.sends_heartbeats = true;
    world.run_s(5);
    EXPECT_EQ(world.sent.size(), autopilot_returned ? 0U : 1U);
  }
}

TEST(failsafe_core, a_command_goes_out_first_and_does_not_wait_for_the_disk) {
  static_assert(godwit::runtime::kind_of<command_vehicle> == godwit::runtime::effect_kind::at_once);
  core alone({}, {}, {});
  alone.take(heartbeat{vehicle_class::multirotor, true, in_mission}, {});
  alone.take(landed{landed_state::in_air}, {});
  alone.take(asked_guard{1, {{fence_of(fence_kind::inclusion, square(100))}, {}, {}}}, {});
  alone.take(position_at(101, 0), {});
  auto second = position_at(101, 0);
  second.boot_ms = 1;
  alone.take(second, {});
  const auto wanted = alone.tick({});
  ASSERT_GE(wanted.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<command_vehicle>(wanted.front()));
  ASSERT_TRUE(std::holds_alternative<remember>(wanted.back()));
  const auto& kept = std::get<remember>(wanted.back()).what;
  EXPECT_EQ(kept.now.reacts.value().phase, reaction_phase::in_flight);
  EXPECT_TRUE(kept.limits.has_value());
}

TEST(failsafe_core, while_nothing_happens_nothing_is_written_and_nothing_is_said) {
  auto world = fenced();
  const auto written = world.remembered;
  const auto said = world.warnings.size();
  world.run_s(600);
  EXPECT_EQ(world.remembered, written);
  EXPECT_EQ(world.warnings.size(), said);
}

TEST(failsafe_core, more_overrides_between_two_ticks_than_there_is_room_for_get_no_answer) {
  flight_world world;
  for (std::size_t i = 0; i < max_waiting_overrides + 5; ++i)
    world.override_for_s(rule::fence, 60);
  world.run_s(1);
  EXPECT_EQ(world.answered.size(), max_waiting_overrides);
}

TEST(failsafe_core, what_was_outdated_before_it_was_sent_alerts_nobody) {
  flight_world world;
  world.run_s(5);
  world.refuses = command_verdict::outdated;
  world.battery_percent = 22;
  world.run_s(8);
  ASSERT_FALSE(world.sent.empty());
  EXPECT_FALSE(world.has_warned_of("does not get through"));
  world.refuses.reset();
  world.run_s(3);
  EXPECT_EQ(world.mode.kind, mode_kind::returning);
}

} // namespace core_sending_test
