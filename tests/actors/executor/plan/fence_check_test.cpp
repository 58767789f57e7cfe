#include "actors/executor/plan/fence_check.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace fence_check_test {

using tests::box;
using tests::exclusion;
using tests::inclusion;
using messages = std::vector<std::string>;

mission::document mission_with(std::vector<mission::geofence> fences, std::vector<mission::item> items) {
  auto mission = mission_of(std::move(items));
  mission.geofences = std::move(fences);
  return mission;
}

std::vector<violation> found_in(const mission::document& mission, const plan_setting& setting = px4_copter) {
  std::vector<violation> all;
  const auto plans = build_plans(mission, setting);
  EXPECT_TRUE(plans) << plans.error().message();
  for (const auto& plan : *plans)
    for (auto& each : fence_violations(plan, mission, setting.vehicle))
      all.push_back(std::move(each));
  return all;
}

messages messages_of(const std::vector<violation>& all) {
  messages result;
  for (const auto& each : all)
    result.push_back(each.message);
  return result;
}

const mission::takeoff up{"up", 30};
const mission::return_home back{"back"};
const auto field = inclusion(box(-100, -500, 1000, 500));

mission::geofence between(mission::geofence fence, std::optional<double> floor_m, std::optional<double> ceiling_m) {
  fence.floor_m = floor_m;
  fence.ceiling_m = ceiling_m;
  return fence;
}

TEST(fence_check, a_way_inside_of_its_fences_is_in_order) {
  EXPECT_TRUE(found_in(mission_with({}, {up, waypoint("w", at(5000, 0, 900)), back})).empty());
  EXPECT_TRUE(found_in(mission_with({between(field, 0, 120), exclusion(box(400, 100, 500, 200))},
                                    {up, waypoint("w", at(900, 0, 30)), back}))
                  .empty());
}

TEST(fence_check, a_waypoint_outside_names_the_fence_the_leg_and_the_item) {
  const auto found = found_in(mission_with({field}, {up, waypoint("w", at(1200, 0, 30)), back}));
  ASSERT_EQ(found.size(), 2U) << "the way there and the way back";
  EXPECT_EQ(found[0].kind, violation_kind::outside_inclusion);
  EXPECT_EQ(found[0].fence, 0U);
  EXPECT_EQ(found[0].leg, 1U);
  EXPECT_EQ(found[0].item_index, 1U);
  EXPECT_EQ(found[0].message, "The way to item 'w' leaves geofence 1, which it has to stay in.");
  EXPECT_EQ(found[1].message, "The way to item 'back' lies outside of all inclusion fences.");
}

TEST(fence_check, a_leg_counts_and_not_only_its_ends) {
  const auto dented = inclusion({{-100, -500}, {1000, -500}, {1000, 500}, {500, -100}, {-100, 500}});
  const auto found = found_in(mission_with({dented}, {up, waypoint("w", at(950, 0, 30))}));
  ASSERT_EQ(messages_of(found), (messages{"The way to item 'w' leaves geofence 1, which it has to stay in."}));
  const auto crossed =
      found_in(mission_with({field, exclusion(box(400, -50, 500, 50))}, {up, waypoint("w", at(900, 0, 30))}));
  ASSERT_EQ(messages_of(crossed), (messages{"The way to item 'w' comes into geofence 2, which excludes it."}));
  EXPECT_EQ(crossed[0].kind, violation_kind::inside_exclusion);
}

TEST(fence_check, a_leg_may_go_from_one_inclusion_into_another_that_overlaps) {
  const auto items = std::vector<mission::item>{up, waypoint("w", at(900, 0, 30))};
  EXPECT_TRUE(
      found_in(mission_with({inclusion(box(-100, -50, 500, 50)), inclusion(box(400, -50, 950, 50))}, items)).empty());
  EXPECT_FALSE(
      found_in(mission_with({inclusion(box(-100, -50, 400, 50)), inclusion(box(500, -50, 950, 50))}, items)).empty());
}

TEST(fence_check, a_side_belongs_to_both_kinds) {
  EXPECT_TRUE(found_in(mission_with({inclusion(box(-100, 0, 900, 500))}, {up, waypoint("w", at(900, 0, 30))})).empty());
  EXPECT_FALSE(found_in(mission_with({exclusion(box(200, 0, 300, 500))}, {up, waypoint("w", at(900, 0, 30))})).empty());
}

TEST(fence_check, altitudes_are_held_against_floor_and_ceiling) {
  const auto high = found_in(mission_with({between(field, 0, 40)}, {up, waypoint("w", at(900, 0, 45))}));
  ASSERT_EQ(messages_of(high), (messages{"The way to item 'w' goes above the ceiling of geofence 1."}));
  EXPECT_EQ(high[0].kind, violation_kind::above_ceiling);
  const auto low = found_in(mission_with({between(field, 20, 120)}, {up, waypoint("w", at(900, 0, 15))}));
  ASSERT_EQ(messages_of(low), (messages{"The way to item 'w' goes below the floor of geofence 1."}));
  EXPECT_EQ(low[0].kind, violation_kind::below_floor);
  EXPECT_EQ(low[0].fence, 0U);
}

TEST(fence_check, climbing_from_the_ground_and_landing_are_not_held_against_floors) {
  EXPECT_TRUE(found_in(mission_with({between(field, 20, 120)},
                                    {up, waypoint("w", at(900, 0, 30)), mission::land{"down", at(900, 0, 0)}}))
                  .empty());
  EXPECT_EQ(
      messages_of(found_in(mission_with({between(field, 20, 25)}, {up, mission::land{"down", at(0, 0, 0)}}))).at(0),
      "The climb of item 'up' goes above the ceiling of geofence 1.");
}

TEST(fence_check, an_exclusion_above_or_below_the_way_is_no_obstacle) {
  const auto items = std::vector<mission::item>{up, waypoint("w", at(900, 0, 50))};
  const auto block = exclusion(box(400, -50, 500, 50));
  EXPECT_TRUE(found_in(mission_with({between(block, 60, {})}, items)).empty());
  EXPECT_TRUE(found_in(mission_with({between(block, {}, 20)}, items)).empty());
  EXPECT_FALSE(found_in(mission_with({between(block, 45, 60)}, items)).empty())
      << "where on the leg it climbs is the vehicle's business";
}

TEST(fence_check, the_lines_of_a_survey_and_the_ways_between_them_count) {
  const auto items = std::vector<mission::item>{up, survey_of("s", box(300, -200, 600, 200), 40, 90)};
  EXPECT_TRUE(found_in(mission_with({between(field, 0, 60)}, items)).empty());
  const auto found = found_in(mission_with({exclusion(box(595, -10, 700, 10))}, items));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].item_index, 1U);
}

TEST(fence_check, the_circle_of_a_plane_counts) {
  const auto items = std::vector<mission::item>{up, mission::loiter{"look", at(850, 0, 30), 0, 60}};
  EXPECT_TRUE(found_in(mission_with({field}, items), px4_plane).empty());
  const auto near_the_edge = std::vector<mission::item>{up, mission::loiter{"look", at(950, 0, 30), 0, 60}};
  EXPECT_EQ(messages_of(found_in(mission_with({field}, near_the_edge), px4_plane)).at(0),
            "The circle of item 'look' leaves geofence 1, which it has to stay in.");
  EXPECT_TRUE(found_in(mission_with({field}, near_the_edge), px4_copter).empty()) << "it hovers";
}

TEST(fence_check, a_rover_keeps_to_all_fences_whatever_their_altitudes) {
  const auto items = std::vector<mission::item>{waypoint("w", at(900, 0, 0))};
  EXPECT_TRUE(found_in(mission_with({between(field, 20, 120)}, items), rover).empty());
  EXPECT_FALSE(found_in(mission_with({between(exclusion(box(400, -50, 500, 50)), 20, 120)}, items), rover).empty());
}

TEST(fence_check, the_return_counts_with_its_altitude) {
  auto setting = px4_copter;
  setting.return_altitude_m = 60;
  const auto mission = mission_with({between(field, 0, 50)}, {up, waypoint("w", at(900, 0, 30)), back});
  EXPECT_TRUE(found_in(mission).empty());
  EXPECT_EQ(messages_of(found_in(mission, setting)).at(0),
            "The way to item 'back' goes above the ceiling of geofence 1.");
}

TEST(fence_check, across_the_antimeridian) {
  const geo::point around{-17, 179.999};
  auto mission = mission_of({up});
  const auto place = [&](double east_m) {
    const auto there = tests::place(east_m, 0, around);
    return mission::position{there.latitude_deg, there.longitude_deg, 30};
  };
  mission.items.emplace_back(waypoint("w", place(900)));
  mission.geofences = {tests::fence(mission::fence_kind::inclusion, box(-100, -50, 950, 50), around)};
  auto setting = px4_copter;
  setting.start = place(0);
  setting.start.altitude_m = 0;
  EXPECT_TRUE(found_in(mission, setting).empty());
  mission.items.emplace_back(waypoint("v", place(1000)));
  EXPECT_EQ(found_in(mission, setting).size(), 1U);
}

TEST(fence_check, there_is_a_bound) {
  std::vector<mission::item> items{up};
  for (int i = 0; i < 100; ++i)
    items.emplace_back(waypoint("w" + std::to_string(i), at(5000 + i, 0, 30)));
  EXPECT_EQ(found_in(mission_with({field}, items)).size(), max_violations);
}

TEST(fence_check, the_way_of_a_return_to_home_leads_to_the_home_of_the_vehicle) {
  auto mission = mission_of({mission::takeoff{"up", 30}, waypoint("out", at(300, 0, 30)),
                             mission::return_home{"back", mission::return_goal::home}});
  mission.return_point.reset();
  mission.geofences = {tests::exclusion(tests::box(140, -20, 160, 20))};
  auto setting = px4_copter;
  setting.start = at(300, 300, 0);
  const auto violations = [&] {
    return fence_violations(build_plans(mission, setting)->front(), mission, vehicle_class::multirotor);
  };
  EXPECT_TRUE(violations().empty()) << "home moves to where it is armed, and the way back leads around";
  setting.start = at(0, 0, 0);
  EXPECT_FALSE(violations().empty());
}

TEST(fence_check, the_return_point_lies_inside_whatever_the_altitude) {
  auto mission = mission_with({between(field, 20, 30), exclusion(box(400, -50, 500, 50))}, {up});
  EXPECT_TRUE(return_point_violations(mission).empty());
  mission.return_point = at(450, 0, 0);
  EXPECT_EQ(messages_of(return_point_violations(mission)),
            (messages{"The return point comes into geofence 2, which excludes it."}));
  mission.return_point = at(4500, 0, 0);
  EXPECT_EQ(messages_of(return_point_violations(mission)),
            (messages{"The return point lies outside of all inclusion fences."}));
}

} // namespace fence_check_test
} // namespace godwit::executor::plan
