#include "actors/executor/plan/mission_look.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace mission_look_test {

const auto mission =
    mission_of({mission::takeoff{"up", 30}, mission::change_speed{"slow", 4}, waypoint("w", at(100, 0, 30)),
                mission::land{"down", at(200, 0, 0)}, mission::takeoff{"up again", 30}, mission::return_home{"back"}});

TEST(mission_look, the_next_place_is_that_of_the_first_item_that_has_one) {
  EXPECT_EQ(place_after(mission, 0)->longitude, at(100, 0, 0).longitude);
  EXPECT_EQ(place_after(mission, 2)->longitude, at(200, 0, 0).longitude);
  EXPECT_EQ(place_after(mission, 4)->longitude, mission.return_point->longitude);
}

TEST(mission_look, a_take_off_ends_the_search_for_it) { EXPECT_EQ(place_after(mission, 3), std::nullopt); }

TEST(mission_look, the_place_before_is_the_return_point_when_there_is_none) {
  EXPECT_EQ(place_before(mission, 2).longitude, mission.return_point->longitude);
  EXPECT_EQ(place_before(mission, 3).longitude, at(100, 0, 0).longitude);
}

TEST(mission_look, the_speed_is_the_one_asked_for_last) {
  auto with_own = mission;
  std::get<mission::waypoint>(with_own.items[2]).speed_mps = 9;
  EXPECT_EQ(speed_before(mission, 1), std::nullopt);
  EXPECT_EQ(speed_before(mission, 2), 4.0);
  EXPECT_EQ(speed_before(with_own, 5), 9.0);
}

TEST(mission_look, only_a_change_of_speed_may_stand_between_a_place_and_its_landing) {
  const auto slowed =
      mission_of({waypoint("w", at(0, 0, 30)), mission::change_speed{"slow", 4}, mission::land{"down", at(200, 0, 0)}});
  EXPECT_TRUE(leads_to_landing(slowed, 0));
  EXPECT_TRUE(leads_to_landing(mission, 2));
  EXPECT_FALSE(leads_to_landing(mission, 0));
  EXPECT_FALSE(leads_to_landing(mission, 5));
}

} // namespace mission_look_test
} // namespace godwit::executor::plan
