#include "actors/executor/plan/item_planner.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace item_planner_test {

using commands = std::vector<int>;

const mission::takeoff take_off_item{"up", 30};
const mission::waypoint out = waypoint("out", at(500, 0, 30));
const mission::return_home home_again{"back"};

mission::land land_at(const mission::position& place) { return {"down", place}; }

plan_setting under_way(plan_setting setting, const mission::position& where) {
  setting.is_under_way = true;
  setting.start = where;
  return setting;
}

TEST(item_planner, a_multirotor_takes_off_where_it_stands) {
  const auto plan = build_plans(mission_of({take_off_item, out}), px4_copter)->front();
  EXPECT_EQ(plan.items[0].x, std::lround(px4_copter.start.latitude * 1e7));
  EXPECT_FLOAT_EQ(plan.items[0].z, 30);
  EXPECT_EQ(plan.legs[0].kind, leg_kind::climb);
}

TEST(item_planner, a_fixed_wing_takes_off_towards_the_next_place) {
  const auto plan =
      build_plans(mission_of({take_off_item, mission::change_speed{"s", 20}, out, home_again}), px4_plane)->front();
  EXPECT_EQ(plan.items[0].y, std::lround(out.at.longitude * 1e7));
  EXPECT_FLOAT_EQ(plan.items[0].z, 30);
}

TEST(item_planner, a_fixed_wing_that_has_nowhere_to_take_off_to_is_refused) {
  EXPECT_EQ(why_not(mission_of({take_off_item, home_again}), px4_plane),
            "Item 'up': A fixed wing takes off towards the next place, and none is at least 20 m away; put a waypoint "
            "after it, in the direction of the runway.");
  EXPECT_NE(why_not(mission_of({take_off_item, waypoint("near", at(3, 0, 30)), out}), ardupilot_plane), "");
}

TEST(item_planner, a_fixed_wing_in_the_air_does_not_take_off_again) {
  EXPECT_EQ(commands_of(mission_of({take_off_item, out}), under_way(px4_plane, at(0, 0, 60))), (commands{16}));
  EXPECT_EQ(commands_of(mission_of({take_off_item, out}), under_way(px4_copter, at(0, 0, 10))), (commands{22, 16}));
}

TEST(item_planner, a_rover_does_not_take_off_and_the_item_is_in_the_map_all_the_same) {
  const auto plan = build_plans(mission_of({take_off_item, out}), rover)->front();
  EXPECT_EQ(commands_of(plan), (commands{16}));
  EXPECT_EQ(plan.map.items[0].item_id, "up");
  EXPECT_EQ(plan.map.items[0].sequence_count, 0);
}

TEST(item_planner, who_stands_on_the_ground_begins_with_a_take_off) {
  EXPECT_EQ(why_not(mission_of({out}), px4_copter),
            "Item 'out': The vehicle stands on the ground there; put a takeoff in front of it.");
  EXPECT_NE(why_not(mission_of({out, land_at(at(500, 0, 0))}), ardupilot_plane), "");
  EXPECT_EQ(why_not(mission_of({out}), rover), "");
  EXPECT_EQ(why_not(mission_of({out}), under_way(px4_copter, at(0, 0, 20))), "");
}

TEST(item_planner, behind_a_landing_comes_a_take_off) {
  const auto mission = mission_of({take_off_item, land_at(at(500, 0, 0)), waypoint("on", at(900, 0, 30))});
  EXPECT_EQ(why_not(mission, px4_copter),
            "Item 'on': The vehicle stands on the ground there; put a takeoff in front of it.");
}

TEST(item_planner, a_take_off_does_not_come_in_the_middle_of_a_flight) {
  EXPECT_EQ(why_not(mission_of({take_off_item, out, mission::takeoff{"higher", 60}}), px4_copter),
            "Item 'higher': A take-off does not come in the middle of a flight; put a waypoint there, which climbs as "
            "well, or a land in front of it.");
  EXPECT_EQ(why_not(mission_of({mission::change_speed{"slow", 3}, take_off_item, out}), px4_copter), "");
}

TEST(item_planner, a_waypoint_has_its_hold_radius_and_speed) {
  auto slow = out;
  slow.hold_s = 12;
  slow.accept_radius_m = 3;
  slow.speed_mps = 5;
  const auto plan = build_plans(mission_of({take_off_item, slow}), ardupilot_copter)->front();
  EXPECT_EQ(commands_of(plan), (commands{22, 178, 16}));
  EXPECT_FLOAT_EQ(plan.items[2].param2, 5);
  EXPECT_FLOAT_EQ(plan.items[3].param1, 12);
  EXPECT_FLOAT_EQ(plan.items[3].param2, 3);
}

TEST(item_planner, a_fixed_wing_holds_by_circling) {
  auto held = out;
  held.hold_s = 12;
  const auto plan = build_plans(mission_of({take_off_item, held}), px4_plane)->front();
  EXPECT_EQ(commands_of(plan), (commands{22, 19}));
  EXPECT_FLOAT_EQ(plan.items[1].param1, 12);
  EXPECT_EQ(plan.items[1].param3, 0) << "with its own radius";
  EXPECT_EQ(plan.legs.back().kind, leg_kind::circle);
}

TEST(item_planner, a_loiter_is_a_time_and_for_a_rover_a_stop) {
  const auto mission = mission_of({take_off_item, mission::loiter{"look", at(200, 0, 30), -40, 60}});
  const auto copter = build_plans(mission, px4_copter)->front();
  EXPECT_EQ(copter.items[1].command, 19);
  EXPECT_FLOAT_EQ(copter.items[1].param1, 60);
  EXPECT_FLOAT_EQ(copter.items[1].param3, -40);
  EXPECT_NE(copter.legs.back().kind, leg_kind::circle) << "it hovers";
  const auto driven = build_plans(mission, rover)->front();
  EXPECT_EQ(driven.items[0].command, 16);
  EXPECT_FLOAT_EQ(driven.items[0].param1, 60);
}

TEST(item_planner, an_ardupilot_plane_is_not_asked_for_circles_that_it_does_not_keep) {
  const auto mission_with = [](double radius_m) {
    return mission_of({take_off_item, mission::loiter{"look", at(900, 0, 30), radius_m, 60}});
  };
  EXPECT_EQ(why_not(mission_with(200), ardupilot_plane),
            "Item 'look': It asks for circles of 200 m, and an ArduPilot plane flies its own of 80 m; set radius_m to "
            "0, and WP_LOITER_RAD in the vehicle.");
  EXPECT_EQ(why_not(mission_with(0), ardupilot_plane), "");
  EXPECT_EQ(why_not(mission_with(-80), ardupilot_plane), "");
  EXPECT_EQ(why_not(mission_with(200), px4_plane), "");
  EXPECT_EQ(why_not(mission_with(200), ardupilot_copter), "");
}

TEST(item_planner, an_ardupilot_waits_no_longer_than_its_number_can_say) {
  auto held = out;
  held.hold_s = 70'000;
  EXPECT_EQ(why_not(mission_of({take_off_item, held}), ardupilot_copter),
            "Item 'out': It waits for 70000 s, and the vehicle knows 65535 s at most; divide the time over several "
            "items.");
  EXPECT_EQ(why_not(mission_of({take_off_item, held}), px4_copter), "");
}

TEST(item_planner, latitude_and_longitude_0_are_refused) {
  EXPECT_EQ(why_not(mission_of({take_off_item, waypoint("null", {0, 0, 30})}), px4_copter),
            "Item 'null': Its place is latitude 0 and longitude 0, which vehicles take for none; move it by a metre.");
  EXPECT_NE(why_not(mission_of({take_off_item, mission::loiter{"l", {0, 0, 30}, 0, 5}}), rover), "");
  EXPECT_NE(why_not(mission_of({take_off_item, out, mission::land{"down", {0, 0, 0}}}), px4_copter), "");
}

TEST(item_planner, a_survey_gives_two_waypoints_for_each_line_at_its_altitude) {
  const auto plan =
      build_plans(mission_of({take_off_item, survey_of("field", tests::box(100, 0, 300, 90), 30, 90)}), px4_copter)
          ->front();
  ASSERT_EQ(commands_of(plan), (commands{22, 16, 16, 16, 16, 16, 16}));
  EXPECT_FLOAT_EQ(plan.items[1].z, 50);
  ASSERT_EQ(plan.surveys.size(), 1U);
  EXPECT_EQ(plan.surveys[0].first_line_sequence, 1);
  EXPECT_EQ(plan.surveys[0].line_count, 3);
}

TEST(item_planner, a_survey_that_can_not_be_flown_is_refused) {
  EXPECT_EQ(why_not(mission_of({take_off_item, survey_of("field", tests::box(0, 0, 3000, 3000), 1)}), px4_copter),
            "Item 'field': Its area would take more than 2000 lines; put the lines farther apart, or divide the area.");
  EXPECT_NE(why_not(mission_of({take_off_item, survey_of("field", tests::box(0, 0, 60'000, 100), 10)}), px4_copter),
            "");
  EXPECT_NE(why_not(mission_of({take_off_item, survey_of("field", tests::box(0, 0, 0.02, 0.02), 10)}), px4_copter), "");
}

TEST(item_planner, a_multirotor_flies_over_the_place_and_lands) {
  const auto plan = build_plans(mission_of({take_off_item, out, land_at(at(700, 0, 2))}), px4_copter)->front();
  EXPECT_EQ(commands_of(plan), (commands{22, 16, 21}));
  EXPECT_FLOAT_EQ(plan.items[2].z, 2);
  EXPECT_EQ(plan.legs.back().kind, leg_kind::descent);
  EXPECT_DOUBLE_EQ(plan.legs.back().from.altitude_m, 30);
  EXPECT_TRUE(plan.ends_on_ground);
}

TEST(item_planner, a_rover_drives_to_where_it_shall_land_and_stops) {
  const auto plan = build_plans(mission_of({out, land_at(at(700, 0, 0))}), rover)->front();
  EXPECT_EQ(commands_of(plan), (commands{16, 16}));
  EXPECT_TRUE(plan.ends_on_ground);
}

TEST(item_planner, a_fixed_wing_lands_from_a_place_that_is_higher_and_not_too_steep) {
  EXPECT_EQ(why_not(mission_of({take_off_item, out, land_at(at(900, 0, 0))}), px4_plane), "");
  EXPECT_EQ(why_not(mission_of({take_off_item, out, land_at(at(560, 0, 0))}), px4_plane),
            "Item 'down': The way down to it has 27 degrees, and a fixed wing can 15; put the waypoint in front of it "
            "lower or farther away.");
  EXPECT_EQ(why_not(mission_of({take_off_item, out, land_at(at(900, 0, 40))}), px4_plane),
            "Item 'down': A fixed wing comes down to its landing from a place that is higher; put a waypoint in front "
            "of it, higher and some hundred metres away.");
  EXPECT_NE(why_not(mission_of({take_off_item, land_at(at(900, 0, 0))}), ardupilot_plane), "");
  EXPECT_NE(why_not(mission_of({land_at(at(900, 0, 0))}), under_way(px4_plane, at(0, 0, 60))), "");
}

TEST(item_planner, the_way_down_of_a_fixed_wing_is_marked_when_that_is_asked_for) {
  const auto mission = mission_of({take_off_item, out, waypoint("final", at(800, 0, 25)), land_at(at(1300, 0, 0))});
  auto setting = px4_plane;
  EXPECT_EQ(commands_of(mission, setting), (commands{22, 16, 16, 21}));
  setting.marks_landings = true;
  const auto plan = build_plans(mission, setting)->front();
  EXPECT_EQ(commands_of(plan), (commands{22, 16, 189, 16, 21}));
  EXPECT_EQ(plan.landing_sequence, 2);
  EXPECT_EQ(plan.map.items[2].first_sequence, 2);
  EXPECT_EQ(plan.map.items[2].first_nav_sequence, 3);
}

TEST(item_planner, returning_home_is_the_vehicles_own_return) {
  for (const auto& setting : {px4_copter, ardupilot_copter, px4_plane, rover}) {
    const auto plan = build_plans(mission_of({take_off_item, out, home_again}), setting)->front();
    EXPECT_EQ(plan.items.back().command, 20);
    EXPECT_EQ(plan.ends_at.longitude, at(0, 0, 0).longitude);
  }
}

TEST(item_planner, a_vehicle_that_returns_climbs_to_its_return_altitude_first) {
  auto setting = px4_copter;
  setting.return_altitude_m = 60;
  const auto plan = build_plans(mission_of({take_off_item, out, home_again}), setting)->front();
  double highest_m = 0;
  for (const auto& each : plan.legs)
    highest_m = std::max(highest_m, each.to.altitude_m);
  EXPECT_DOUBLE_EQ(highest_m, 60);
}

TEST(item_planner, a_return_point_that_is_not_home_is_flown_to_as_a_place) {
  auto mission = mission_of({take_off_item, out, home_again});
  mission.return_point = at(0, 300, 4);
  const auto plan = build_plans(mission, px4_copter)->front();
  EXPECT_EQ(commands_of(plan), (commands{22, 16, 16, 21}));
  EXPECT_FLOAT_EQ(plan.items[2].z, 30) << "as high as it flies";
  EXPECT_FLOAT_EQ(plan.items[3].z, 4);
  EXPECT_EQ(commands_of(mission, rover), (commands{16, 16}));
  EXPECT_EQ(
      why_not(mission, px4_plane),
      "Item 'back': The vehicle would return to its home, and the return point is elsewhere; put a waypoint and a "
      "land in its place.");
}

TEST(item_planner, the_return_from_a_delivery_does_not_rely_on_a_home_that_moves) {
  const auto mission =
      mission_of({take_off_item, land_at(at(700, 0, 0)), mission::takeoff{"up again", 30}, home_again});
  EXPECT_EQ(commands_of(mission, px4_copter), (commands{22, 21, 22, 16, 21}));
}

TEST(item_planner, a_return_to_home_is_the_vehicles_own_wherever_the_return_point_and_the_planned_home_are) {
  auto mission = mission_of({take_off_item, out, mission::return_home{"back", mission::return_goal::home}});
  mission.planned_home = mission::planned_home{at(0, 350, 0).latitude, at(0, 350, 0).longitude, 431};
  for (const auto& there : {std::optional<mission::position>(), std::optional(at(0, 300, 4))}) {
    mission.return_point = there;
    for (const auto& setting : {px4_copter, ardupilot_copter, px4_plane, ardupilot_plane, rover}) {
      const auto plans = build_plans(mission, setting);
      ASSERT_TRUE(plans.has_value()) << plans.error().message();
      EXPECT_EQ(plans->front().items.back().command, 20);
      EXPECT_EQ(plans->front().ends_at.longitude, at(0, 0, 0).longitude) << "energy and fences count the way home";
      EXPECT_EQ(plans->front().legs.back().to.latitude, at(0, 0, 0).latitude);
    }
  }
}

// Home is set again to where the mission first took off.
TEST(item_planner, a_return_to_home_from_a_delivery_leads_to_the_home_of_the_mission) {
  const auto mission = mission_of({take_off_item, land_at(at(700, 0, 0)), mission::takeoff{"up again", 30},
                                   mission::return_home{"back", mission::return_goal::home}});
  const auto plans = build_plans(mission, px4_copter);
  ASSERT_TRUE(plans.has_value()) << plans.error().message();
  EXPECT_EQ(commands_of(mission, px4_copter), (commands{22, 21, 22, 20}));
  EXPECT_EQ(plans->back().ends_at.longitude, at(0, 0, 0).longitude);
}

TEST(item_planner, a_return_to_a_return_point_that_is_missing_is_refused) {
  auto mission = mission_of({take_off_item, out, home_again});
  mission.return_point.reset();
  EXPECT_EQ(why_not(mission, px4_copter),
            "Item 'back': It returns to the return point, and the mission has none; give the mission a return point, "
            "or send the vehicle to its home (\"to\": \"HOME\").");
}

TEST(item_planner, landing_or_returning_where_the_vehicle_stands_is_nothing_to_do) {
  const auto mission = mission_of({take_off_item, out, home_again, land_at(at(2, 0, 0))});
  const auto plans = build_plans(mission, px4_copter);
  ASSERT_EQ(plans->size(), 1U);
  EXPECT_EQ(commands_of(plans->front()), (commands{22, 16, 20}));
  EXPECT_EQ(plans->front().map.items.back().item_id, "down");
  EXPECT_EQ(commands_of(mission_of({home_again, take_off_item, out}), px4_copter), (commands{22, 16}));
}

} // namespace item_planner_test
} // namespace godwit::executor::plan
