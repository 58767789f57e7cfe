#include "programs/godwit-sim/vehicle/flight/item_place.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/flight/flight_fixture.hpp"

namespace godwit::sim::test {
namespace item_place_test {

constexpr position start_place{46, 7, 433};

item in_frame(std::uint8_t frame, float z) {
  auto made = waypoint(100, 0, z);
  made.frame = frame;
  return made;
}

TEST(sim_item_place, frames_0_and_5_count_from_sea_level) {
  for (const std::uint8_t frame : {0, 5})
    EXPECT_EQ(place_of(in_frame(frame, 450), home, start_place)->at.altitude_m, 450) << int{frame};
}

TEST(sim_item_place, frames_3_6_10_and_11_count_from_home) {
  for (const std::uint8_t frame : {3, 6, 10, 11})
    EXPECT_EQ(place_of(in_frame(frame, 50), home, start_place)->at.altitude_m, 450) << int{frame};
}

TEST(sim_item_place, other_frames_are_refused_with_a_sentence) {
  for (const std::uint8_t frame : {1, 4, 7, 12, 255})
    EXPECT_EQ(place_of(in_frame(frame, 50), home, start_place).error(),
              "frame " + std::to_string(frame) + " is not known");
}

TEST(sim_item_place, frame_2_has_no_position) {
  const auto place = place_of(in_frame(2, 50), home, start_place);
  EXPECT_TRUE(place->is_here);
  EXPECT_EQ(place->at.latitude_deg, start_place.latitude_deg);
  EXPECT_EQ(place->at.altitude_m, 450);
}

TEST(sim_item_place, degrees_are_exact_to_the_unit) {
  auto made = waypoint(0, 0);
  made.x = -338'000'001;
  made.y = 1'512'345'678;
  const auto place = place_of(made, home, start_place);
  EXPECT_DOUBLE_EQ(place->at.latitude_deg, -33.8000001);
  EXPECT_DOUBLE_EQ(place->at.longitude_deg, 151.2345678);
}

TEST(sim_item_place, zero_zero_means_here_for_takeoff_landing_and_loiter) {
  for (const auto command : {nav_takeoff, nav_land, nav_loiter_unlim, nav_loiter_time, nav_loiter_turns}) {
    auto made = at(command, 0, 0, 0);
    made.x = made.y = 0;
    const auto place = place_of(made, home, start_place);
    EXPECT_TRUE(place->is_here) << command;
    EXPECT_FALSE(place->has_own_altitude) << command;
    EXPECT_EQ(place->at, start_place) << command;
    made.z = 20;
    EXPECT_EQ(place_of(made, home, start_place)->at.altitude_m, 420) << command;
  }
}

TEST(sim_item_place, zero_zero_is_a_place_for_a_waypoint) {
  auto made = waypoint(0, 0);
  made.x = made.y = 0;
  EXPECT_FALSE(place_of(made, home, start_place)->is_here);
  EXPECT_EQ(place_of(made, home, start_place)->at.latitude_deg, 0);
}

TEST(sim_item_place, the_largest_integer_means_here) {
  auto made = waypoint(0, 0);
  made.x = std::numeric_limits<std::int32_t>::max();
  EXPECT_TRUE(place_of(made, home, start_place)->is_here);
}

TEST(sim_item_place, an_altitude_that_is_no_number_is_that_of_the_vehicle) {
  for (const float z : {std::nanf(""), HUGE_VALF}) {
    const auto place = place_of(waypoint(10, 0, z), home, start_place);
    EXPECT_FALSE(place->has_own_altitude);
    EXPECT_EQ(place->at.altitude_m, start_place.altitude_m);
  }
}

TEST(sim_item_place, what_is_not_on_earth_is_refused) {
  auto north = waypoint(0, 0);
  north.x = 950'000'000;
  EXPECT_EQ(place_of(north, home, start_place).error(), "its position is not on Earth");
  auto east = waypoint(0, 0);
  east.y = -1'800'000'001;
  EXPECT_FALSE(place_of(east, home, start_place));
}

} // namespace item_place_test
} // namespace godwit::sim::test
