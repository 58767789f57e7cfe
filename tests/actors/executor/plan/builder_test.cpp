#include "actors/executor/plan/builder.hpp"

#include <cstdio>

#include <gtest/gtest.h>

#include "tests/actors/executor/plan/missions.hpp"

namespace godwit::executor::plan {
namespace builder_test {

using commands = std::vector<int>;
using lines = std::vector<std::string>;

std::string line_of(const io::mavlink::mission_item_int& item) {
  char text[160];
  std::snprintf(text, sizeof text, "%d%s %d/%d: %g %g %g %g | %d %d %g", item.seq, item.current != 0 ? "*" : "",
                item.frame, item.command, static_cast<double>(item.param1), static_cast<double>(item.param2),
                static_cast<double>(item.param3), static_cast<double>(item.param4), item.x, item.y,
                static_cast<double>(item.z));
  return text;
}

lines lines_of(const flight_plan& plan) {
  lines result;
  for (const auto& each : plan.items)
    result.push_back(line_of(each));
  return result;
}

// "up 0-0, slow 1-1, ...": the items of the mission with their sequences; - for none.
std::string map_of(const flight_plan& plan) {
  std::string result;
  for (const auto& each : plan.map.items) {
    const int first = each.first_sequence;
    result +=
        (result.empty() ? "" : ", ") + std::to_string(each.item_index) + ' ' + each.item_id + ' ' +
        (each.sequence_count == 0 ? "-"
                                  : std::to_string(first) + '-' + std::to_string(first + each.sequence_count - 1));
  }
  return result;
}

mission::document small_mission() {
  mission::document mission;
  mission.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  mission.return_point = {47.3977419, 8.5455938, 0};
  mission.items = {mission::takeoff{"up", 40}, mission::change_speed{"slow", 6.5},
                   mission::waypoint{"corner", {47.3985, 8.5465, 40}, 2.5, 2, 8.0},
                   mission::loiter{"look", {47.399, 8.547, 45}, -20, 60}, mission::return_home{"home"}};
  return mission;
}

plan_setting small_setting(mav_autopilot autopilot) {
  plan_setting setting;
  setting.autopilot = autopilot;
  setting.start = {47.3977420, 8.5455940, 0};
  setting.home = {47.3977420, 8.5455940, 488.1, 0};
  return setting;
}

TEST(builder, a_small_mission_for_px4) {
  const auto plans = build_plans(small_mission(), small_setting(mav_autopilot::px4));
  ASSERT_TRUE(plans);
  ASSERT_EQ(plans->size(), 1U);
  EXPECT_EQ(lines_of(plans->front()), (lines{
                                          "0* 3/22: 0 0 0 nan | 473977420 85455940 40",
                                          "1 2/178: 1 6.5 -1 0 | 0 0 0",
                                          "2 2/178: 1 8 -1 0 | 0 0 0",
                                          "3 3/16: 2.5 2 0 nan | 473985000 85465000 40",
                                          "4 3/19: 60 0 -20 0 | 473990000 85470000 45",
                                          "5 2/20: 0 0 0 0 | 0 0 0",
                                      }));
  EXPECT_EQ(map_of(plans->front()), "0 up 0-0, 1 slow 1-1, 2 corner 2-3, 3 look 4-4, 4 home 5-5");
  EXPECT_EQ(plans->front().map.first_sequence, 0);
  EXPECT_EQ(plans->front().map.start_sequence, 0);
  EXPECT_EQ(plans->front().map.total, 6);
  EXPECT_TRUE(plans->front().map.ends_mission);
}

TEST(builder, a_small_mission_for_ardupilot) {
  const auto plans = build_plans(small_mission(), small_setting(mav_autopilot::ardupilotmega));
  ASSERT_TRUE(plans);
  EXPECT_EQ(lines_of(plans->front()), (lines{
                                          "0 0/16: 0 0 0 0 | 473977420 85455940 488.1",
                                          "1* 3/22: 0 0 0 0 | 473977420 85455940 40",
                                          "2 2/178: 1 6.5 -1 0 | 0 0 0",
                                          "3 2/178: 1 8 -1 0 | 0 0 0",
                                          "4 3/16: 3 2 0 0 | 473985000 85465000 40",
                                          "5 3/19: 60 0 -20 0 | 473990000 85470000 45",
                                          "6 2/20: 0 0 0 0 | 0 0 0",
                                      }));
  EXPECT_EQ(map_of(plans->front()), "0 up 1-1, 1 slow 2-2, 2 corner 3-4, 3 look 5-5, 4 home 6-6");
  EXPECT_EQ(plans->front().map.first_sequence, 1);
  EXPECT_EQ(plans->front().map.start_sequence, 1);
  EXPECT_EQ(plans->front().map.total, 6) << "home is not counted";
}

TEST(builder, the_way_of_a_small_mission) {
  const auto plan = build_plans(small_mission(), small_setting(mav_autopilot::px4))->front();
  std::string kinds;
  for (const auto& each : plan.legs)
    kinds += std::to_string(each.item_index) + (each.kind == leg_kind::climb     ? "climb "
                                                : each.kind == leg_kind::descent ? "descent "
                                                                                 : "cruise ");
  EXPECT_EQ(kinds, "0climb 2cruise 3cruise 4cruise 4descent ");
  for (std::size_t i = 1; i < plan.legs.size(); ++i)
    EXPECT_EQ(plan.legs[i].from, plan.legs[i - 1].to) << "each begins where the one before ends";
}

TEST(builder, the_rest_of_a_mission_has_the_indices_of_the_mission_and_the_speed_in_force) {
  auto setting = small_setting(mav_autopilot::px4);
  setting.is_under_way = true;
  const auto plan = build_plans(small_mission(), setting, {3, 0})->front();
  EXPECT_EQ(map_of(plan), "3 look 0-1, 4 home 2-2");
  EXPECT_EQ(commands_of(plan), (commands{178, 19, 20}));
  EXPECT_FLOAT_EQ(plan.items[0].param2, 8);
  EXPECT_EQ(plan.items[0].current, 1);
  EXPECT_EQ(plan.items[1].current, 0);
}

TEST(builder, a_delivery_is_several_plans_of_one_mission) {
  const auto mission = mission_of({mission::takeoff{"up", 30}, mission::waypoint{"out", at(400, 0, 30), 0, 0, 9.0},
                                   mission::land{"deliver", at(800, 0, 0)}, mission::takeoff{"up again", 30},
                                   waypoint("back", at(400, 0, 30)), mission::land{"down", at(0, 0, 0)}});
  const auto plans = build_plans(mission, ardupilot_copter);
  ASSERT_TRUE(plans);
  ASSERT_EQ(plans->size(), 2U);
  EXPECT_EQ(map_of(plans->at(0)), "0 up 1-1, 1 out 2-3, 2 deliver 4-4");
  EXPECT_EQ(map_of(plans->at(1)), "3 up again 1-1, 4 back 2-3, 5 down 4-4");
  EXPECT_EQ(commands_of(plans->at(1)), (commands{22, 178, 16, 21})) << "the speed holds on in the second plan";
  EXPECT_FALSE(plans->at(0).map.ends_mission);
  EXPECT_TRUE(plans->at(1).map.ends_mission);
  EXPECT_TRUE(plans->at(0).ends_on_ground);
  EXPECT_EQ(plans->at(1).legs.front().from.longitude, plans->at(0).ends_at.longitude);
  EXPECT_EQ(plans->at(1).items[1].y, std::lround(at(800, 0, 0).longitude * 1e7)) << "it takes off where it landed";
}

TEST(builder, items_behind_the_last_landing_that_fly_nothing_belong_to_the_plan_before) {
  const auto mission =
      mission_of({mission::takeoff{"up", 30}, mission::land{"down", at(100, 0, 0)}, mission::change_speed{"late", 4}});
  const auto plans = build_plans(mission, px4_copter);
  ASSERT_EQ(plans->size(), 1U);
  EXPECT_EQ(map_of(plans->front()), "0 up 0-0, 1 down 1-1, 2 late -");
}

TEST(builder, a_survey_goes_on_at_the_line_that_was_begun) {
  const auto mission = mission_of(
      {mission::takeoff{"up", 50}, survey_of("field", tests::box(100, 0, 400, 200), 20), mission::return_home{"home"}});
  const auto whole = build_plans(mission, px4_copter)->front();
  ASSERT_EQ(whole.surveys.at(0).line_count, 10);
  auto setting = px4_copter;
  setting.is_under_way = true;
  setting.start = at(250, 60, 50);
  const auto lines_before = lines_done_at(whole.surveys[0], 8); // on its way along the fourth line
  EXPECT_EQ(lines_before, 3U);
  const auto rest = build_plans(mission, setting, {1, lines_before})->front();
  ASSERT_EQ(rest.surveys.at(0).line_count, 7);
  EXPECT_EQ(rest.surveys[0].lines_before, 3U);
  for (std::size_t i = 0; i < 14; ++i) {
    EXPECT_EQ(rest.items[i].x, whole.items[i + 7].x);
    EXPECT_EQ(rest.items[i].y, whole.items[i + 7].y);
  }
  EXPECT_EQ(commands_of(mission, setting, {1, 10}), (commands{20})) << "all lines are flown";
}

TEST(builder, a_mission_that_moves_nothing_is_refused) {
  EXPECT_EQ(why_not(mission_of({mission::change_speed{"slow", 4}}), px4_copter),
            "The mission: No item of it moves the vehicle; give it a place to go to.");
  EXPECT_NE(why_not(mission_of({mission::takeoff{"up", 10}}), rover), "");
}

TEST(builder, a_vehicle_of_an_unknown_kind_gets_no_plan) {
  const auto mission = mission_of({mission::takeoff{"up", 30}, waypoint("out", at(500, 0, 30))});
  const auto plans = build_plans(mission, setting_of(vehicle_class::unknown));
  ASSERT_FALSE(plans);
  EXPECT_EQ(plans.error().code, plan_errc::unknown_vehicle);
}

TEST(builder, what_is_behind_the_end_of_the_mission_can_not_be_planned) {
  EXPECT_EQ(why_not(small_mission(), px4_copter, {5, 0}),
            "The mission: It has 5 items, and none with index 5; begin with an item that it has.");
}

TEST(builder, a_plan_has_a_bound) {
  std::vector<mission::item> items{mission::takeoff{"up", 30}};
  for (std::size_t i = 1; i < max_plan_items; ++i)
    items.emplace_back(waypoint("w" + std::to_string(i), at(static_cast<double>(i), 0, 30)));
  auto mission = mission_of(items);
  EXPECT_EQ(why_not(mission, px4_copter), "");
  mission.items.emplace_back(waypoint("last", at(0, 10, 30)));
  EXPECT_EQ(why_not(mission, px4_copter),
            "Item 'last': With it the plan has more than 5000 vehicle items; put a land in between, or the lines of "
            "surveys farther apart.");
}

TEST(builder, a_flight_that_was_broken_off_takes_off_again_from_the_ground_for_its_rest) {
  const auto setting = small_setting(mav_autopilot::px4);
  const auto plans = build_plans(small_mission(), setting, {2, 0});
  ASSERT_TRUE(plans) << plans.error().message();
  EXPECT_EQ(map_of(plans->front()), "2 corner 0-2, 3 look 3-3, 4 home 4-4");
  EXPECT_EQ(plans->front().items.front().command, 22) << "NAV_TAKEOFF";
  EXPECT_FLOAT_EQ(plans->front().items.front().z, 40);
  auto in_the_air = setting;
  in_the_air.is_under_way = true;
  in_the_air.start.altitude_m = 40;
  EXPECT_NE(build_plans(small_mission(), in_the_air, {2, 0})->front().items.front().command, 22);
}

} // namespace builder_test
} // namespace godwit::executor::plan
