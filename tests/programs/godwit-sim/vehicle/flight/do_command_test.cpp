#include "programs/godwit-sim/vehicle/flight/do_command.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace do_command_test {

constexpr position here{46, 7, 433};

struct sim_do_command : testing::Test {
  craft what = multirotor_craft();
  pace how_fast = own_pace(what);
  position home_now = home;

  std::optional<std::string> carry(const item& which) { return carry_out(which, what, here, how_fast, home_now); }
};

TEST_F(sim_do_command, change_speed_knows_four_kinds) {
  EXPECT_EQ(carry(command(do_change_speed, 0, 7)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 7);
  EXPECT_EQ(carry(command(do_change_speed, 1, 8)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 8);
  EXPECT_EQ(carry(command(do_change_speed, 2, 1)), std::nullopt);
  EXPECT_EQ(how_fast.climb_mps, 1);
  EXPECT_EQ(carry(command(do_change_speed, 3, 0.5F)), std::nullopt);
  EXPECT_EQ(how_fast.descent_mps, 0.5);
  EXPECT_EQ(carry(command(do_change_speed, 4, 1)), "this kind of speed is not known");
}

TEST_F(sim_do_command, minus_1_keeps_the_speed_and_minus_2_is_the_crafts_own) {
  how_fast.speed_mps = 9;
  EXPECT_EQ(carry(command(do_change_speed, 1, -1)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 9);
  EXPECT_EQ(carry(command(do_change_speed, 1, -2)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, what.speed_mps);
}

TEST_F(sim_do_command, a_speed_of_nothing_is_refused_and_every_other_is_bounded) {
  for (const float none : {0.0F, -5.0F, std::nanf("")}) {
    EXPECT_EQ(carry(command(do_change_speed, 1, none)), "it names no speed") << none;
    EXPECT_EQ(how_fast.speed_mps, what.speed_mps);
  }
  EXPECT_EQ(carry(command(do_change_speed, 1, 1e9F)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 20);
  EXPECT_EQ(carry(command(do_change_speed, 1, 1e-9F)), std::nullopt);
  EXPECT_EQ(how_fast.speed_mps, 0.1);
}

TEST_F(sim_do_command, home_is_set_here_or_at_the_position) {
  EXPECT_EQ(carry(command(do_set_home, 1)), std::nullopt);
  EXPECT_EQ(home_now, here);
  auto place = at(do_set_home, 100, 0, 500);
  place.frame = 0;
  EXPECT_EQ(carry(place), std::nullopt);
  EXPECT_EQ(home_now.altitude_m, 500);
  EXPECT_NEAR(between(home, home_now).distance_m, 100, 0.02);
}

TEST_F(sim_do_command, a_home_that_is_not_on_earth_is_refused) {
  auto place = at(do_set_home, 0, 0, 0);
  place.x = 2'000'000'000;
  EXPECT_EQ(carry(place), "its position is not on Earth");
  EXPECT_EQ(home_now, home);
}

TEST_F(sim_do_command, what_is_not_known_says_so) {
  for (const std::uint16_t each : {186, 208, 12'345}) // refused by all, guarded, no command
    EXPECT_EQ(carry(command(each)), "command " + std::to_string(each) + " is not known");
}

TEST_F(sim_do_command, cameras_servos_and_grippers_are_executed_in_silence) {
  for (const std::uint16_t each : {183, 195, 201, 205, 206, 211, 2000, 3000})
    EXPECT_EQ(carry(command(each)), std::nullopt) << each;
}

TEST_F(sim_do_command, jumps_delays_and_marks_are_passed_over_in_silence) {
  for (const auto each : {do_jump, condition_delay, do_land_start})
    EXPECT_EQ(carry(command(each, 1, 1)), std::nullopt) << each;
}

} // namespace do_command_test
} // namespace godwit::sim::test
