#include "actors/executor/plan/vehicle_items.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace vehicle_items_test {

const mission::position place{47.5, -8.25, 30};

TEST(vehicle_items, positions_are_above_home_in_1e7_degrees) {
  const auto item = waypoint_item(place, 3, 2, px4_copter);
  EXPECT_EQ(item.frame, 3);
  EXPECT_EQ(item.x, 475'000'000);
  EXPECT_EQ(item.y, -82'500'000);
  EXPECT_FLOAT_EQ(item.z, 30);
  EXPECT_FLOAT_EQ(item.param1, 3);
  EXPECT_FLOAT_EQ(item.param2, 2);
  EXPECT_EQ(item.autocontinue, 1);
}

TEST(vehicle_items, altitudes_are_counted_from_the_home_that_the_vehicle_has_now) {
  auto setting = px4_copter;
  setting.home.above_mission_zero_m = 12;
  EXPECT_FLOAT_EQ(waypoint_item(place, 0, 0, setting).z, 18);
}

TEST(vehicle_items, no_yaw_is_nan_for_px4_and_0_for_ardupilot) {
  EXPECT_TRUE(std::isnan(waypoint_item(place, 0, 0, px4_copter).param4));
  EXPECT_TRUE(std::isnan(land_item(place, rover).param4));
  for (const auto& item : {waypoint_item(place, 0, 0, ardupilot_copter), land_item(place, ardupilot_copter),
                           takeoff_item(place, ardupilot_copter), loiter_item(place, 1, 0, ardupilot_copter)})
    EXPECT_EQ(item.param4, 0);
}

TEST(vehicle_items, ardupilot_waits_for_whole_seconds_and_never_less_than_asked_for) {
  EXPECT_FLOAT_EQ(waypoint_item(place, 0.4, 0, ardupilot_copter).param1, 1);
  EXPECT_FLOAT_EQ(loiter_item(place, 2, 0, ardupilot_copter).param1, 2);
  EXPECT_FLOAT_EQ(waypoint_item(place, 0.4, 0, px4_copter).param1, 0.4F);
  EXPECT_EQ(longest_wait_s(ardupilot_copter), 65'535);
}

TEST(vehicle_items, speed_is_over_ground_and_for_planes_through_the_air) {
  EXPECT_EQ(speed_item(7, px4_copter).param1, 1);
  EXPECT_EQ(speed_item(7, rover).param1, 1);
  EXPECT_EQ(speed_item(7, px4_plane).param1, 0);
  EXPECT_EQ(speed_item(7, px4_plane).param2, 7);
  EXPECT_EQ(speed_item(7, px4_plane).param3, -1) << "the throttle is left alone";
  EXPECT_EQ(speed_item(7, px4_plane).frame, 2);
}

TEST(vehicle_items, home_is_an_item_of_ardupilot_alone_and_above_the_sea) {
  EXPECT_TRUE(keeps_home_as_item(ardupilot_plane));
  EXPECT_FALSE(keeps_home_as_item(px4_copter));
  EXPECT_FALSE(keeps_home_as_item(rover));
  EXPECT_EQ(home_item(ardupilot_copter).frame, 0);
  EXPECT_FLOAT_EQ(home_item(ardupilot_copter).z, 431);
}

TEST(vehicle_items, commands_up_to_95_move_the_vehicle) {
  EXPECT_TRUE(is_nav(return_item()));
  EXPECT_TRUE(is_nav(land_item(place, px4_copter)));
  EXPECT_FALSE(is_nav(speed_item(5, px4_copter)));
  EXPECT_FALSE(is_nav(landing_start_item()));
}

TEST(vehicle_items, what_ends_the_pictures_is_what_has_begun_them) {
  const auto command = [](std::uint16_t which, float p1, float p2 = 0, float p3 = 0) {
    mission_item_int made;
    made.command = which;
    made.param1 = p1;
    made.param2 = p2;
    made.param3 = p3;
    return made;
  };
  const auto stop = [](std::vector<mission_item_int> items) {
    const auto found = camera_to_stop(items, items.size());
    return found ? std::pair(int{found->command}, found->param1) : std::pair(0, 0.0F);
  };
  EXPECT_EQ(stop({command(206, 25, 0, 1)}), std::pair(206, 0.0F));
  EXPECT_EQ(stop({command(206, 25), command(206, 0)}), std::pair(0, 0.0F));
  EXPECT_EQ(stop({command(214, 1000)}), std::pair(214, 0.0F));
  EXPECT_EQ(stop({command(2003, 1)}), std::pair(2003, 0.0F));
  EXPECT_EQ(stop({command(2000, 2, 5, 0)}), std::pair(2001, 2.0F)) << "of the same camera";
  EXPECT_EQ(stop({command(2000, 0, 5, 0), command(2001, 0)}), std::pair(0, 0.0F));
  EXPECT_EQ(stop({command(2000, 0, 0, 1)}), std::pair(0, 0.0F)) << "a single picture";
  EXPECT_FALSE(camera_to_stop(std::vector{command(16, 0), command(206, 25)}, 1)) << "not there yet";
}

TEST(vehicle_items, what_the_plan_has_set_before_a_place_is_known_as_it_was_set_last) {
  const auto of = [](std::uint16_t number, float second) {
    mission_item_int item;
    item.command = number;
    item.param2 = second;
    return item;
  };
  const std::vector items{of(178, 5), of(195, 0), of(16, 0),  of(205, 1), of(178, 7),
                          of(206, 0), of(16, 1),  of(197, 0), of(178, 9)};
  const auto at = [&](std::size_t sequence) {
    std::vector<std::pair<int, float>> result;
    for (const auto& each : state_at(items, sequence))
      result.emplace_back(each.command, each.param2);
    return result;
  };
  using found = std::vector<std::pair<int, float>>;
  EXPECT_EQ(at(0), found());
  EXPECT_EQ(at(2), (found{{178, 5}, {195, 0}}));
  EXPECT_EQ(at(6), (found{{178, 7}, {195, 0}, {205, 1}}));
  EXPECT_EQ(at(99), (found{{178, 9}, {205, 1}})) << "a region of interest that was ended";
}

TEST(vehicle_items, latitude_and_longitude_0_are_nowhere) {
  EXPECT_TRUE(is_nowhere({0, 0, 20}));
  EXPECT_TRUE(is_nowhere({1e-8, -1e-8, 20})) << "rounded to 1e-7 degrees";
  EXPECT_FALSE(is_nowhere({0, 1e-6, 20}));
}

} // namespace vehicle_items_test
} // namespace godwit::executor::plan
