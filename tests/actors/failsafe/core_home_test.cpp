// The core: where a return leads after a landing on the way.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/actors/failsafe/flights.hpp"

namespace core_home_test {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::flight::home_place;

constexpr home_place depot{47.397742, 8.545594, 488};
constexpr home_place customer{47.402, 8.545594, 488};

void guard_with_home(flight_world& world) { world.tell(asked_guard{1, {{}, {}, {}, depot}}); }

void guard_with_home_moved(flight_world& world) {
  guard_with_home(world);
  world.tell(home_told{customer});
  world.run_s(2);
}

// The battery is low until somebody is asked for a plan.
std::uint64_t drain_until_asked(flight_world& world) {
  while (world.battery_percent > 22) {
    world.battery_percent = std::max(22, world.battery_percent - 15);
    world.run_s(1);
  }
  for (int i = 0; i < 200 && !world.told().return_asked; ++i)
    world.run_ms(100);
  EXPECT_TRUE(world.told().return_asked);
  return world.told().return_asked.value_or(asked_return{}).number;
}

TEST(failsafe_home, where_its_return_leads_elsewhere_the_executor_is_asked_for_a_plan_and_nothing_is_sent) {
  for (const auto what : classes) {
    flight_world world(what);
    guard_with_home_moved(world);
    const auto number = drain_until_asked(world);
    EXPECT_TRUE(world.has_warned_of("m from the home of the mission"));
    world.tell(return_taken{number, true, {}});
    world.run_s(30);
    EXPECT_TRUE(world.sent.empty());
    EXPECT_FALSE(world.told().return_asked) << "it is answered";
  }
}

TEST(failsafe_home, a_worse_cause_takes_the_place_of_the_one_for_which_a_plan_was_asked) {
  flight_world world;
  world.tell(asked_guard{1, {{fence_of(godwit::mission::fence_kind::inclusion, square(100))}, {}, {}, depot}});
  world.tell(home_told{customer});
  world.run_s(5);
  const auto number = drain_until_asked(world);
  const auto first = world.told().return_asked.value_or(asked_return{}).why;
  world.tell(return_taken{number, true, {}});
  world.east_m = 101;
  world.run_s(2);
  ASSERT_TRUE(world.kept().now.by_plan);
  EXPECT_NE(world.kept().now.by_plan->why, first);
  EXPECT_TRUE(world.sent.empty()) << "the way home is under way already";
}

TEST(failsafe_home, handed_back_it_asks_anew) {
  flight_world world;
  guard_with_home_moved(world);
  const auto number = drain_until_asked(world);
  world.tell(return_taken{number, true, {}});
  world.run_ms(300);
  world.tell(hand_back{});
  world.run_ms(300);
  EXPECT_GT(world.told().return_asked.value_or(asked_return{}).number, number);
}

TEST(failsafe_home, what_is_worse_than_a_return_ends_the_one_by_a_plan) {
  flight_world world;
  guard_with_home_moved(world);
  world.tell(return_taken{drain_until_asked(world), true, {}});
  drain_to(world, 5);
  EXPECT_EQ(actions_of(world), these{action::land});
  EXPECT_FALSE(world.kept().now.by_plan);
}

TEST(failsafe_home, an_executor_has_a_second_and_a_half_to_answer) {
  flight_world world;
  guard_with_home_moved(world);
  (void)drain_until_asked(world);
  world.run_ms(plan_answer_ms - 100);
  EXPECT_TRUE(world.sent.empty());
  world.run_ms(200);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_home, an_executor_that_is_down_leaves_it_to_the_vehicles_own_return_and_the_difference_is_told) {
  for (const auto what : classes) {
    flight_world world(what);
    guard_with_home_moved(world);
    drain_to(world, 22);
    world.run_s(3);
    EXPECT_EQ(actions_of(world), these{action::return_home});
    EXPECT_TRUE(world.has_warned_of("m from the home of the mission"));
    EXPECT_TRUE(world.has_warned_of("the executor does not answer"));
  }
}

TEST(failsafe_home, a_plan_that_the_executor_can_not_fly_leaves_it_to_the_vehicles_own_return) {
  flight_world world;
  guard_with_home_moved(world);
  const auto number = drain_until_asked(world);
  world.tell(return_taken{number + 1, false, "of another request"});
  world.run_ms(200);
  EXPECT_TRUE(world.sent.empty());
  world.tell(return_taken{number, false, "no position"});
  world.run_s(1);
  EXPECT_EQ(actions_of(world), these{action::return_home});
  EXPECT_TRUE(world.has_warned_of("no position"));
}

TEST(failsafe_home, of_the_arming_is_that_of_a_first_flight_and_who_moves_it_moves_no_return) {
  for (const bool restarts : {false, true}) {
    flight_world world;
    world.armed = false;
    world.landed = landed_state::on_ground;
    world.set_fences({});
    world.run_s(3);
    world.tell(home_told{customer}); // from before
    world.armed = true;
    world.run_s(3);
    world.tell(home_told{depot});
    world.landed = landed_state::in_air;
    world.run_s(3);
    world.tell(home_told{customer}); // by somebody
    world.run_s(1);
    if (restarts)
      world.restart();
    world.run_s(1);
    EXPECT_NE(drain_until_asked(world), 0U);
    EXPECT_TRUE(world.sent.empty());
  }
}

TEST(failsafe_home, that_was_moved_before_the_vehicle_told_it_is_the_one_at_which_it_was_armed) {
  for (const bool restarts : {false, true}) {
    flight_world world;
    world.armed = false;
    world.landed = landed_state::on_ground;
    world.run_s(3);
    world.tell(asked_guard{1, {{}, {}, {}, {}, depot}});
    world.run_s(1);
    world.armed = true;
    world.run_s(1);
    world.tell(home_told{customer}); // the first word after the arming
    world.landed = landed_state::in_air;
    world.run_s(3);
    if (restarts)
      world.restart();
    world.run_s(1);
    EXPECT_NE(drain_until_asked(world), 0U);
    EXPECT_TRUE(world.sent.empty());
  }
}

TEST(failsafe_home, what_is_asked_for_is_asked_for_again_after_a_restart) {
  flight_world world;
  guard_with_home_moved(world);
  const auto number = drain_until_asked(world);
  world.restart();
  world.run_ms(300);
  EXPECT_EQ(world.told().return_asked.value_or(asked_return{}).number, number);
  world.tell(return_taken{number, true, {}});
  world.run_s(20);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_home, a_pilot_who_takes_it_meanwhile_is_left_alone) {
  flight_world world;
  guard_with_home_moved(world);
  (void)drain_until_asked(world);
  world.tell(taken_over{});
  world.run_s(10);
  EXPECT_TRUE(world.sent.empty());
}

TEST(failsafe_home, that_is_the_missions_is_returned_to) {
  flight_world world;
  guard_with_home(world);
  world.tell(home_told{depot});
  world.run_s(2);
  drain_to(world, 22);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_home, of_a_first_flight_is_wherever_the_vehicle_has_it) {
  flight_world world;
  world.set_fences({});
  world.tell(home_told{customer});
  world.run_s(2);
  drain_to(world, 22);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

TEST(failsafe_home, a_critical_battery_lands_wherever_home_is) {
  flight_world world;
  guard_with_home_moved(world);
  world.tell(return_taken{drain_until_asked(world), true, {}});
  drain_to(world, 12);
  EXPECT_EQ(actions_of(world), these{action::land});
}

TEST(failsafe_home, since_an_arming_home_is_not_known_until_it_is_told) {
  for (const bool is_told : {false, true}) {
    flight_world world;
    world.armed = false;
    world.landed = landed_state::on_ground;
    world.run_s(3);
    guard_with_home(world);
    world.tell(home_told{depot});
    world.armed = true;
    world.landed = landed_state::in_air;
    world.run_s(3);
    if (is_told)
      world.tell(home_told{depot});
    drain_to(world, 22);
    world.run_s(3);
    EXPECT_EQ(actions_of(world), these{is_told ? action::return_home : action::hold});
  }
}

TEST(failsafe_home, is_remembered_over_a_restart) {
  flight_world world;
  guard_with_home(world);
  world.tell(home_told{depot});
  world.run_s(2);
  world.restart();
  world.run_s(2);
  drain_to(world, 22);
  EXPECT_EQ(actions_of(world), these{action::return_home});
}

} // namespace core_home_test
