#include "actors/domain/mission/place_limits.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "tests/actors/domain/mission/mission_maker.hpp"

namespace godwit::mission {
namespace place_limits_test {

using flight::vehicle_class;

constexpr geo::point zurich{47.397742, 8.545594};
constexpr place_limits limits{10'000, 500};

limits_origin at_home(const geo::point& home = zurich, vehicle_class vehicle = vehicle_class::multirotor) {
  return {home, 0, vehicle};
}

document mission_of(std::vector<item> items) {
  document result;
  result.items = std::move(items);
  return result;
}

waypoint waypoint_to(double latitude, double longitude, double altitude_m = 20) {
  return {"w2", {latitude, longitude, altitude_m}, 0, 0, {}};
}

std::vector<std::string> found_in(std::vector<item> items, const limits_origin& origin = at_home()) {
  return places_out_of_limits(mission_of(std::move(items)), 0, origin, limits);
}

using sentences = std::vector<std::string>;

TEST(place_limits, a_mission_near_home_keeps_to_them) {
  EXPECT_EQ(found_in({takeoff{"up", 20}, waypoint_to(47.398, 8.546), return_home{"back", return_goal::home}}),
            sentences{});
}

TEST(place_limits, a_place_with_latitude_and_longitude_swapped_is_named_with_the_place_that_was_meant) {
  EXPECT_EQ(found_in({takeoff{"up", 20}, waypoint_to(47.398, 8.546), waypoint_to(8.546, 47.399)}),
            sentences{"Item 3 'w2' is 5,650 km south-east of home; at most 10 km are allowed (flight.max_distance_m); "
                      "with latitude and longitude swapped it would be 140 m away."});
}

TEST(place_limits, a_mission_of_another_place_is_named_with_distance_and_direction) {
  const auto found = found_in({takeoff{"up", 20}, waypoint_to(-35.3633, 149.1652)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front(), "Item 2 'w2' is 16,500 km east of home; at most 10 km are allowed "
                           "(flight.max_distance_m).");
}

TEST(place_limits, heights_are_judged_above_home) {
  EXPECT_EQ(found_in({waypoint_to(47.398, 8.546, 11'000)}),
            sentences{"Item 1 'w2' is 11,000 m above home; at most 500 m are allowed (flight.max_altitude_m)."});
  EXPECT_EQ(found_in({takeoff{"up", 501}}),
            sentences{"Item 1 'up' is 501 m above home; at most 500 m are allowed (flight.max_altitude_m)."});
  auto on_a_hill = at_home();
  on_a_hill.home_altitude_m = 300;
  EXPECT_EQ(found_in({waypoint_to(47.398, 8.546, 700)}, on_a_hill), sentences{});
}

TEST(place_limits, a_rover_has_no_heights) {
  EXPECT_EQ(found_in({waypoint_to(47.398, 8.546, 12'670)}, at_home(zurich, vehicle_class::rover)), sentences{});
  EXPECT_EQ(found_in({waypoint_to(8.546, 47.398)}, at_home(zurich, vehicle_class::rover)).size(), 1U);
}

TEST(place_limits, each_kind_of_item_with_a_place_is_judged) {
  const position far{47.6, 8.5, 20};
  auto mission = mission_of({loiter{"l", far, 0, 5}, land{"d", far}, return_home{"back", {}},
                             survey{"s", {{47.398, 8.546}, {47.6, 8.546}, {47.398, 8.55}}, 50, 20, {}}});
  mission.return_point = far;
  const auto found = places_out_of_limits(mission, 0, at_home(), limits);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[2], "Item 3 'back', the return point, is 22.7 km north of home; at most 10 km are allowed "
                      "(flight.max_distance_m).");
}

TEST(place_limits, a_return_to_home_is_not_judged_by_the_return_point_nor_by_the_planned_home) {
  auto mission = mission_of({return_home{"back", return_goal::home}});
  mission.return_point = position{0, 0, 0};
  mission.planned_home = planned_home{0, 0, {}};
  EXPECT_EQ(places_out_of_limits(mission, 0, at_home(), limits), sentences{});
}

TEST(place_limits, what_is_flown_already_is_not_judged) {
  const auto mission = mission_of({waypoint_to(8.546, 47.398), waypoint_to(47.398, 8.546)});
  EXPECT_EQ(places_out_of_limits(mission, 1, at_home(), limits), sentences{});
}

TEST(place_limits, distances_lead_across_the_antimeridian) {
  const auto fiji = at_home({-17, 179.99});
  EXPECT_EQ(found_in({waypoint_to(-17, -179.99)}, fiji), sentences{}) << "2.1 km to the east";
  EXPECT_EQ(found_in({waypoint_to(-17, -179.5)}, fiji),
            sentences{"Item 1 'w2' is 54.3 km east of home; at most 10 km are allowed (flight.max_distance_m)."});
  EXPECT_EQ(found_in({waypoint_to(-17, 180)}, at_home({-17, -180})), sentences{});
}

TEST(place_limits, the_list_is_bounded) {
  EXPECT_EQ(found_in(std::vector<item>(200, waypoint_to(8.546, 47.398))).size(), max_places_out_of_limits);
}

RC_GTEST_PROP(place_limits_property, no_place_beyond_them_is_passed_and_none_within_is_refused, ()) {
  mission_maker maker(*rc::gen::arbitrary<std::uint64_t>());
  const geo::point home{maker.number(-89, 89), maker.number(-180, 180)};
  const auto away_m = maker.number(1, 20'000);
  const auto at = geo::destination(home, maker.number(0, 360), away_m);
  const auto height_m = maker.number(0, 1000);
  RC_PRE(std::abs(away_m - limits.max_distance_m) > 0.01);
  const bool is_within = away_m < limits.max_distance_m && height_m <= limits.max_altitude_m;
  RC_ASSERT(found_in({waypoint_to(at.latitude_deg, at.longitude_deg, height_m)}, at_home(home)).empty() == is_within);
}

} // namespace place_limits_test
} // namespace godwit::mission
