// A failsafe that starts again in mid-flight.
#include <gtest/gtest.h>

#include "tests/actors/failsafe/flight_world.hpp"

namespace core_restart_test {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::mission::fence_kind;

flight_world fenced() {
  flight_world world;
  world.set_fences({fence_of(fence_kind::inclusion, square(100))});
  world.run_s(10);
  return world;
}

flight_world returning() {
  auto world = fenced();
  world.east_m = 101;
  world.run_s(3);
  EXPECT_EQ(world.mode, in_return);
  return world;
}

TEST(failsafe_restart, what_was_done_is_not_done_again) {
  auto world = returning();
  for (int i = 0; i < 10; ++i) {
    world.restart();
    world.run_ms(3'700);
  }
  EXPECT_EQ(world.sent.size(), 1U);
}

TEST(failsafe_restart, between_the_command_and_its_answer_it_sends_no_second_one) {
  for (const std::int64_t obeys_after_ms : {0, 40, 500, 900}) {
    auto world = fenced();
    world.obeys_after_ms = obeys_after_ms;
    world.east_m = 101;
    world.run_ms(300);
    ASSERT_EQ(world.sent.size(), 1U);
    world.restart();
    world.run_s(20);
    EXPECT_EQ(world.sent.size(), 1U) << obeys_after_ms;
  }
}

TEST(failsafe_restart, a_command_that_was_lost_goes_out_again_after_a_look_at_the_vehicle) {
  auto world = fenced();
  world.hears = false;
  world.east_m = 101;
  world.run_ms(100);
  world.restart();
  world.hears = true;
  world.run_s(20);
  EXPECT_EQ(world.obeyed.size(), 1U);
  EXPECT_EQ(world.mode, in_return);
}

TEST(failsafe_restart, it_acts_on_nothing_before_it_has_heard_the_vehicle) {
  auto world = fenced();
  world.sends_heartbeats = false;
  world.restart();
  world.east_m = 101;
  world.run_s(4);
  EXPECT_TRUE(world.sent.empty());
  world.sends_heartbeats = true;
  world.run_s(1);
  EXPECT_EQ(world.sent.size(), 1U);
}

TEST(failsafe_restart, it_judges_the_fences_though_the_executor_is_dead) {
  auto world = fenced();
  world.restart(); // and nobody tells it the fences again
  world.run_s(2);
  world.east_m = 101;
  world.run_s(1);
  EXPECT_EQ(world.sent.size(), 1U);
}

TEST(failsafe_restart, already_returning_or_landing_by_others_it_latches_and_does_not_send) {
  for (const auto& mode : {in_return, in_landing}) {
    auto world = fenced();
    world.restart();
    world.mode = mode;
    world.east_m = 101;
    world.run_s(20);
    EXPECT_TRUE(world.sent.empty());
    EXPECT_EQ(world.kept().now.latches, (std::vector<latch>{{rule::fence, latch_kind::left_to_pilot}}));
  }
}

TEST(failsafe_restart, changed_by_others_meanwhile_it_latches_and_does_not_send) {
  for (const auto& mode : {in_manual, in_hold, in_loiter, flight_mode{mode_kind::unknown, 77}}) {
    auto world = fenced();
    world.restart();
    world.mode = mode;
    world.east_m = 101;
    world.run_s(20);
    EXPECT_TRUE(world.sent.empty());
    EXPECT_TRUE(world.has_warned_of("a pilot has the vehicle, nothing is sent"));
  }
}

TEST(failsafe_restart, started_for_the_first_time_in_mid_flight_it_leaves_a_return_and_a_pilot_alone) {
  for (const auto& mode : {in_return, in_landing, in_manual, in_hold, in_loiter}) {
    flight_world world;
    world.mode = mode;
    world.set_fences({fence_of(fence_kind::inclusion, square(100))});
    world.east_m = 101;
    world.run_s(20);
    EXPECT_TRUE(world.sent.empty());
  }
}

TEST(failsafe_restart, a_worse_thing_after_the_restart_still_acts) {
  auto world = returning();
  world.restart();
  world.run_s(2);
  for (const int percent : {65, 50, 35, 20, 12}) {
    world.battery_percent = percent;
    world.run_s(1);
  }
  world.run_s(8);
  ASSERT_EQ(world.sent.size(), 2U);
  EXPECT_EQ(world.sent[1].what, action::land) << "it was our return, and the battery is critical now";
}

TEST(failsafe_restart, a_record_that_never_reached_the_disk_makes_no_second_return) {
  auto world = fenced();
  world.east_m = 101;
  world.run_ms(300);
  ASSERT_EQ(world.sent.size(), 1U);
  world.run_ms(200); // the vehicle obeys while the process is being killed and started
  world.kill(2);
  EXPECT_FALSE(world.kept().now.reacts.has_value());
  world.run_s(20);
  EXPECT_EQ(world.sent.size(), 1U);
}

TEST(failsafe_restart, a_takeover_still_stands) {
  auto world = fenced();
  world.mode = in_manual;
  world.run_s(2);
  world.restart();
  world.mode = in_mission;
  world.east_m = 101;
  world.run_s(20);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_restart, an_override_still_holds_and_still_ends) {
  auto world = fenced();
  world.override_for_s(rule::fence, 60);
  world.run_s(10);
  world.restart();
  world.east_m = 101;
  world.run_s(49);
  EXPECT_TRUE(world.sent.empty());
  world.run_s(2);
  EXPECT_EQ(world.sent.size(), 1U);
}

TEST(failsafe_restart, an_operator_who_was_seen_can_still_be_lost_and_no_sooner) {
  flight_world world;
  world.run_s(10);
  world.operator_there = false;
  world.run_s(10);
  world.restart();
  world.port_alive = false; // its memory went with the process
  world.run_s(19);
  EXPECT_TRUE(world.sent.empty());
  world.run_s(2);
  EXPECT_EQ(world.sent.size(), 1U);
}

TEST(failsafe_restart, on_the_ground_an_operator_of_an_earlier_flight_is_forgotten) {
  flight_world world;
  world.landed = landed_state::on_ground;
  world.run_s(10);
  world.restart();
  world.operator_there = false;
  world.port_alive = false;
  world.run_s(60);
  world.landed = landed_state::in_air;
  world.run_s(60);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_restart, the_exact_mode_that_the_executor_announced_is_still_expected_until_its_deadline) {
  const auto is_pilots = [](const flight_mode& mode, std::int64_t after_s) {
    auto world = fenced();
    world.tell(expect_mode{{in_hold.custom_mode}, 5'000});
    world.run_s(1);
    world.restart();
    world.run_s(after_s);
    world.mode = mode;
    world.run_s(2);
    return world.pilots_seen == 1;
  };
  EXPECT_FALSE(is_pilots(in_hold, 0));
  EXPECT_FALSE(is_pilots(in_hold, 2));
  EXPECT_TRUE(is_pilots(in_hold, 5));
  EXPECT_TRUE(is_pilots(in_loiter, 0));
}

TEST(failsafe_restart, how_the_plan_ends_is_remembered_and_what_is_unclear_stays_so) {
  for (const bool is_end : {false, true}) {
    flight_world world;
    world.set_fences({fence_of(fence_kind::inclusion, square(100))}, {}, {6, false, {in_hold.custom_mode}});
    world.run_s(10);
    world.sends_sequence = false;
    world.sequence = 6;
    world.mode = in_hold;
    world.run_s(1);
    world.east_m = 101;
    world.run_s(1);
    world.restart();
    world.run_s(2);
    EXPECT_TRUE(world.sent.empty());
    world.is_complete = is_end;
    world.sends_sequence = true;
    world.run_s(10);
    EXPECT_EQ(world.sent.size(), is_end ? 1U : 0U);
    EXPECT_EQ(world.pilots_seen, is_end ? 0 : 1);
  }
}

TEST(failsafe_restart, a_flight_that_ended_meanwhile_leaves_no_latch) {
  auto world = returning();
  world.restart();
  world.armed = false;
  world.landed = landed_state::on_ground;
  world.run_s(2);
  EXPECT_TRUE(world.kept().now.latches.empty());
  EXPECT_FALSE(world.kept().now.reacts.has_value());
}

} // namespace core_restart_test
