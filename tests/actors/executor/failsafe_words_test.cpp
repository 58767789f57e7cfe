// Whom a change of the mode is called by the autopilot's own words, and what a person keeps whatever else is found out.
#include <gtest/gtest.h>

#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace failsafe_words_test {

using operators::command_kind;
using sim::personality;
using tests::flight_world;

constexpr std::uint32_t copter_rtl = 6;
constexpr std::uint32_t copter_land = 9;
constexpr std::uint32_t copter_loiter = 5;

void fly(flight_world& world) {
  world.load(tests::short_mission(personality::ardupilot));
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
}

TEST(failsafe_words, before_the_mode_call_it_the_autopilots_and_nothing_is_sent) {
  flight_world world({.who = personality::ardupilot});
  fly(world);
  world.vehicle_says("GCS Failsafe");
  world.switch_mode(copter_rtl);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 5)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::autopilot_failsafe) << world.story();
  const auto orders = world.orders();
  world.run_for(5);
  EXPECT_EQ(world.orders(), orders) << world.story();
}

TEST(failsafe_words, after_the_mode_call_it_the_autopilots_too) {
  flight_world world({.who = personality::ardupilot});
  fly(world);
  const auto orders = world.orders();
  world.switch_mode(copter_land);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 5)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  world.vehicle_says("EKF Failsafe: changed to LAND Mode");
  world.run_for(0.5);
  EXPECT_EQ(world.durable().status.cause, pause_cause::autopilot_failsafe) << world.story();
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_FALSE(world.say(command_kind::resume).is_taken) << "it still has to be handed back";
}

TEST(failsafe_words, long_before_or_after_the_mode_leave_it_a_persons) {
  flight_world world({.who = personality::ardupilot, .speed = 1});
  fly(world);
  world.vehicle_says("GCS Failsafe");
  world.run_for(4);
  world.switch_mode(copter_loiter);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 5)) << world.story();
  world.run_for(4);
  world.vehicle_says("GCS Failsafe");
  world.run_for(0.5);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
}

class own_fence : public testing::TestWithParam<personality> {};

TEST_P(own_fence, that_is_left_is_called_the_autopilots_and_nothing_is_sent) {
  flight_world world({.who = GetParam(), .failsafe = {}});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  const auto orders = world.orders();
  world.vehicle().breach_fence(world.now_ns());
  ASSERT_TRUE(world.run_until([&] { return needs_hand_back(world.durable().status.cause); }, 5)) << world.story();
  world.run_for(0.5);
  EXPECT_EQ(world.durable().status.cause, pause_cause::autopilot_failsafe) << world.story();
  world.run_for(5);
  EXPECT_EQ(world.orders(), orders) << world.story();
  EXPECT_FALSE(world.say(command_kind::resume).is_taken) << "it has to be handed back";
}

INSTANTIATE_TEST_SUITE_P(of, own_fence, testing::Values(personality::ardupilot, personality::plane));

// Its fence may be set to report only; a person who hears of it may act.
TEST(failsafe_words, of_its_fence_count_for_what_changes_with_them_and_not_for_who_has_heard_them) {
  flight_world world({.who = personality::ardupilot, .speed = 1});
  fly(world);
  world.vehicle_says("Circle fence breached");
  world.run_for(0.8);
  world.switch_mode(copter_loiter);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 5)) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
}

// What is found out about the plan meanwhile counts when the vehicle was handed back, and does not hand it back.
TEST(failsafe_words, a_person_keeps_the_vehicle_when_its_autopilot_starts_again) {
  flight_world world({.who = personality::ardupilot});
  fly(world);
  world.switch_mode(copter_loiter);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 5)) << world.story();
  world.vehicle_restarts();
  world.run_for(0.5);
  EXPECT_EQ(world.durable().progress.paused, progress::pause_reason::vehicle_restarted);
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_FALSE(world.say(command_kind::resume).is_taken) << world.story();
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
  world.run_for(0.5);
  EXPECT_EQ(world.durable().status.cause, pause_cause::vehicle_restarted) << world.story();
}

TEST(failsafe_words, a_person_keeps_the_vehicle_when_it_has_a_foreign_plan) {
  constexpr std::uint32_t px4_manual = 1U << 16U;
  flight_world world({.who = personality::px4});
  world.load(tests::short_mission(personality::px4));
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  world.switch_mode(px4_manual);
  ASSERT_TRUE(world.run_until_phase(phase::paused, 5)) << world.story();
  world.vehicle_tells(io::mavlink::mission_current{.seq = 0, .total = 9, .mission_state = 3, .mission_id = 4711});
  world.run_for(0.5);
  EXPECT_EQ(world.durable().progress.paused, progress::pause_reason::foreign_plan) << world.story();
  EXPECT_EQ(world.durable().status.cause, pause_cause::taken_over) << world.story();
  EXPECT_FALSE(world.say(command_kind::resume).is_taken) << world.story();
  ASSERT_TRUE(world.say(command_kind::hand_back).is_taken) << world.story();
  world.run_for(0.5);
  EXPECT_EQ(world.durable().status.cause, pause_cause::foreign_plan) << world.story();
}

} // namespace failsafe_words_test
} // namespace godwit::executor
