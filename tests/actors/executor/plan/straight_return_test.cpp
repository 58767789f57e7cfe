#include "actors/executor/plan/straight_return.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace straight_return_test {

using tests::box;
using tests::exclusion;
using tests::inclusion;
using crossings = std::vector<return_crossing>;

const mission::takeoff up{"up", 30};
const mission::return_home back{"back"};

// North, then east along the far side, then back the same way: what lies in between is never flown over.
mission::document around(std::vector<mission::geofence> fences) {
  auto result = mission_of({up, waypoint("north", at(0, 600, 30)), waypoint("east", at(600, 600, 30)),
                            waypoint("again", at(0, 600, 30)), back});
  result.geofences = std::move(fences);
  return result;
}

crossings found_in(const mission::document& mission, const plan_setting& setting = px4_copter) {
  crossings all;
  const auto plans = build_plans(mission, setting);
  EXPECT_TRUE(plans) << plans.error().message();
  for (const auto& plan : *plans)
    for (const auto& each : straight_return_crossings(plan, mission, setting))
      all.push_back(each);
  return all;
}

TEST(straight_return, names_the_items_on_the_way_to_which_a_fence_lies_between_the_vehicle_and_home) {
  EXPECT_EQ(found_in(around({inclusion(box(-900, -900, 900, 900)), exclusion(box(300, 250, 350, 350))})),
            (crossings{{2, 1}, {3, 1}}));
  EXPECT_TRUE(found_in(around({exclusion(box(-400, 100, -100, 500))})).empty());
}

// From the ends of the leg the way home is free.
TEST(straight_return, a_fence_that_is_seen_from_the_middle_of_a_leg_only_is_found) {
  EXPECT_EQ(found_in(around({exclusion(box(140, 280, 150, 290))})), (crossings{{2, 0}, {3, 0}}));
}

TEST(straight_return, a_fence_above_or_below_the_return_is_not_in_the_way_but_of_a_rover) {
  auto high = exclusion(box(300, 250, 350, 350));
  high.floor_m = 60;
  EXPECT_TRUE(found_in(around({high})).empty());
  auto climbs = px4_copter;
  climbs.return_altitude_m = 80;
  EXPECT_EQ(found_in(around({high}), climbs).size(), 2U);
  auto low = exclusion(box(300, 250, 350, 350));
  low.ceiling_m = 20;
  EXPECT_TRUE(found_in(around({low})).empty());
  EXPECT_EQ(found_in(around({low}), rover).size(), 2U);
}

TEST(straight_return, in_flight_it_is_the_home_that_counts_and_not_where_the_plan_begins) {
  auto flying = px4_copter;
  flying.is_under_way = true;
  flying.start = at(600, 600, 30);
  auto mission = mission_of({waypoint("here", at(600, 650, 30))});
  mission.geofences = {exclusion(box(300, 250, 350, 350))};
  EXPECT_EQ(found_in(mission, flying), (crossings{{0, 0}}));
}

} // namespace straight_return_test
} // namespace godwit::executor::plan
