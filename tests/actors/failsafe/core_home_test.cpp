// The core: where a return leads behind a landing on the way.
#include <gtest/gtest.h>

#include "tests/actors/failsafe/flights.hpp"

namespace core_home_test {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::flight::home_place;

constexpr home_place depot{47.397742, 8.545594, 488};
constexpr home_place customer{47.402, 8.545594, 488};

void guard_with_home(flight_world& world) { world.tell(asked_guard{1, {{}, {}, {}, depot}}); }

TEST(failsafe_home, behind_a_landing_on_the_way_it_holds_where_it_would_return_elsewhere) {
  for (const auto what : classes) {
    flight_world world(what);
    guard_with_home(world);
    world.tell(home_told{customer});
    world.run_s(2);
    drain_to(world, 22);
    EXPECT_EQ(actions_of(world), these{action::hold});
    EXPECT_TRUE(world.has_warned_of("does not lead to the mission's home"));
  }
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
  guard_with_home(world);
  world.tell(home_told{customer});
  world.run_s(2);
  drain_to(world, 22);
  drain_to(world, 12);
  EXPECT_EQ(actions_of(world), (these{action::hold, action::land}));
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
