#include "actors/domain/mission/convert/waypoints_import.hpp"

#include <gtest/gtest.h>

#include "actors/domain/mission/convert/waypoints_export.hpp"
#include "tests/actors/domain/mission/sample_files.hpp"

namespace godwit::mission {
namespace waypoints_import_test {

TEST(waypoints_import, the_first_line_of_mission_planner_is_home) {
  const auto result = import_waypoints(sample_file("mission_planner.waypoints"));
  ASSERT_TRUE(result.has_value()) << result.error().message();
  const auto& mission = result->mission;
  EXPECT_EQ(mission.planned_home, (planned_home{47.3977419, 8.5455938, mission.planned_home->above_sea_m}));
  EXPECT_EQ(mission.return_point, std::nullopt);
  ASSERT_EQ(mission.items.size(), 5U);
  const auto copter =
      import_waypoints(sample_file("mission_planner.waypoints"), {false, {}, vehicle_profile::arducopter})->mission;
  EXPECT_EQ(copter.vehicle, vehicle_profile::arducopter);
  EXPECT_EQ(std::get<loiter>(copter.items[3]).duration_s, 15);
}

TEST(waypoints_import, a_file_without_home_is_taken_whole) {
  const auto result = import_waypoints(sample_file("without_home.waypoints"));
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.planned_home, std::nullopt);
  EXPECT_EQ(result->mission.items.size(), 3U);
}

TEST(waypoints_import, return_to_launch_stays_a_return_to_the_vehicles_home) {
  const auto result = import_waypoints(sample_file("return_to_launch.waypoints"));
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.items.back(), item(return_home{"item-3", return_goal::home}));
  EXPECT_EQ(result->mission.planned_home, (planned_home{47.3990, 8.5500, 488}));
  const auto again = import_waypoints(export_waypoints(result->mission).text, {false, result->mission.mission_id});
  ASSERT_TRUE(again.has_value()) << again.error().message();
  EXPECT_EQ(again->mission, result->mission);
}

TEST(waypoints_import, home_at_0_0_is_no_home) {
  const auto result = import_waypoints("QGC WPL 110\n"
                                       "0\t1\t0\t16\t0\t0\t0\t0\t0\t0\t0\t1\n"
                                       "1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t20\t1\n"
                                       "2\t0\t3\t20\t0\t0\t0\t0\t0\t0\t0\t1\n");
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.planned_home, std::nullopt);
  EXPECT_EQ(result->mission.items.size(), 2U);
}

TEST(waypoints_import, home_may_have_an_acceptance_radius) {
  const auto result = import_waypoints("QGC WPL 110\n"
                                       "0\t1\t0\t16\t0\t2\t0\t0\t47.399\t8.55\t488\t1\n"
                                       "1\t0\t3\t16\t0\t0\t0\t0\t47.398\t8.546\t20\t1\n");
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.planned_home, (planned_home{47.399, 8.55, 488}));
}

TEST(waypoints_import, what_is_wrong_names_the_line) {
  const auto error = import_waypoints("QGC WPL 110\n0\t1\t0\t16\t0\t0\t0\t0\t95\t8\t0\t1\n").error();
  EXPECT_EQ(error.error.code, document_errc::syntax);
  EXPECT_EQ(error.error.problems.at(0).pointer, "line 2");
  EXPECT_EQ(import_waypoints("QGC WPL 110\n").error().error.code, document_errc::wrong_form); // no items
  EXPECT_EQ(import_waypoints("").error().error.code, document_errc::syntax);
}

TEST(waypoints_import, a_loss_and_a_problem_name_the_line_the_item_and_the_command) {
  const std::string text = "# a square\nQGC WPL 110\n"
                           "0\t1\t0\t16\t0\t0\t0\t0\t47.399\t8.55\t488\t1\n\n"
                           "1\t0\t3\t208\t2\t0\t0\t0\t0\t0\t0\t1\n"
                           "2\t0\t3\t16\t-5\t0\t0\t0\t47.398\t8.546\t20\t1\n";
  const auto result = import_waypoints(text, {true, {}, vehicle_profile::arducopter});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().error.message(),
            "line 6 (item 2, NAV_WAYPOINT, \"item-1\"): hold_s is -5; allowed: a number from 0 to 86400");
  EXPECT_EQ(result.error().losses.message(), "item 1 (line 5): DO_PARACHUTE: the item; what it does can not be "
                                             "judged before the flight, or takes protection away; "
                                             "flight.allowed_commands allows it where it names 208; instead: left out");
}

TEST(waypoints_import, lines_whose_items_are_all_left_out_are_refused_whatever_is_allowed) {
  const auto result = import_waypoints("QGC WPL 110\n0\t0\t2\t400\t0\t3\t0\t0\t0\t0\t0\t1\n", {true, {}});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().message(), "the document holds no item that a mission has\n"
                                      "item 0 (line 2): COMPONENT_ARM_DISARM: the item; no mission may stop motors, "
                                      "change the mode, pause or start a mission; instead: left out");
}

TEST(waypoints_import, a_home_of_command_0_is_home) {
  const auto result = import_waypoints("QGC WPL 110\n"
                                       "0\t1\t0\t0\t0\t0\t0\t0\t47.399\t8.55\t488\t1\n"
                                       "1\t0\t3\t16\t0\t0\t0\t0\t47.398\t8.546\t20\t1\n");
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.planned_home, (planned_home{47.399, 8.55, 488}));
}

TEST(waypoints_import, a_fence_is_read_as_a_fence_with_its_point_of_return) {
  const std::string fence = "47.398\t8.546\n47.397\t8.545\n47.399\t8.545\n47.399\t8.547\n47.397\t8.545\n";
  const import_options alone{true, {}, {}, true};
  const auto result = import_waypoints(fence, alone);
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_TRUE(result->mission.items.empty());
  ASSERT_EQ(result->mission.geofences.size(), 1U);
  EXPECT_EQ(result->mission.geofences[0].vertices.size(), 3U);
  EXPECT_EQ(result->mission.breach_return_point, (position{47.398, 8.546, 0}));
  EXPECT_TRUE(result->losses.empty());
  EXPECT_EQ(import_waypoints(fence, {true, {}}).error().error.message(),
            "the document holds a fence alone, which is no mission");
  const auto point = import_waypoints("0 0\n47 8\n48 9\n47 8\n48 9\n", alone);
  EXPECT_EQ(point.error().error.problems.at(0).pointer, "line 2");
}

TEST(waypoints_import, rally_points_alone_are_no_mission_and_are_written_again) {
  const std::string rally = "RALLY 47.398 8.546 60 40 0 0\n";
  EXPECT_EQ(import_waypoints(rally, {true, {}}).error().message(),
            "the document holds rally points alone, which are no mission");
  const import_options alone{false, {}, {}, true};
  const auto read = import_waypoints(rally, alone);
  ASSERT_TRUE(read.has_value()) << read.error().message();
  EXPECT_EQ(read->mission.rally_points, (std::vector<position>{{47.398, 8.546, 60}}));
  const auto written = export_waypoints(read->mission);
  EXPECT_EQ(written.text, "QGC WPL 110\n0\t0\t3\t5100\t0\t0\t0\t0\t47.3980000\t8.5460000\t60\t1\n");
  EXPECT_EQ(import_waypoints(written.text, alone)->mission.rally_points, read->mission.rally_points);
}

TEST(waypoints_import, a_circle_of_a_fence_stays_a_circle) {
  const std::string circle = "QGC WPL 110\n0\t0\t0\t5000\t0\t0\t0\t0\t47.3990000\t8.5460000\t0\t1\n"
                             "1\t0\t0\t5003\t250\t0\t0\t0\t47.3980000\t8.5460000\t0\t1\n";
  const auto read = import_waypoints(circle, {false, {}, {}, true});
  ASSERT_TRUE(read.has_value()) << read.error().message();
  EXPECT_EQ(read->mission.geofences.at(0).circle, (fence_circle{47.398, 8.546, 250}));
  EXPECT_EQ(export_waypoints(read->mission).text, circle);
}

// What a field means depends on who reads it: a yaw of 0 is north for a PX4, and none for an ArduPilot.
TEST(waypoints_import, who_is_to_fly_it_decides_what_godwit_plans_itself) {
  const std::string text = "QGC WPL 110\n"
                           "0\t1\t0\t16\t0\t0\t0\t0\t47.399\t8.55\t488\t1\n"
                           "1\t0\t3\t16\t0\t0\t0\t0\t47.398\t8.546\t20\t1\n"
                           "2\t0\t3\t19\t5\t0\t0\t0\t47.398\t8.546\t20\t1\n";
  const auto kinds_for = [&](std::optional<vehicle_profile> vehicle) {
    const auto mission = import_waypoints(text, {false, {}, vehicle})->mission;
    return std::string(kind_of(mission.items.at(0))) + ' ' + std::string(kind_of(mission.items.at(1)));
  };
  EXPECT_EQ(kinds_for({}), "command command");
  EXPECT_EQ(kinds_for(vehicle_profile::arducopter), "waypoint loiter");
  EXPECT_EQ(kinds_for(vehicle_profile::arduplane), "waypoint command") << "wings circle";
  EXPECT_EQ(kinds_for(vehicle_profile::px4_multicopter), "command loiter") << "north";
}

// Cameras, waits, jumps, splines, heights above the sea: what is written is what was read.
TEST(waypoints_import, lines_of_every_class_come_back_line_by_line) {
  const std::string text = "QGC WPL 110\n"
                           "0\t0\t0\t16\t0\t0\t0\t0\t47.3990000\t8.5500000\t488\t1\n"
                           "1\t0\t3\t22\t15\t0\t0\t0\t47.3900000\t8.5400000\t20\t1\n"
                           "2\t0\t3\t206\t25.5\t0\t1\t0\t0.0000000\t0.0000000\t0\t1\n"
                           "3\t0\t0\t82\t0\t0\t0\t0\t47.3980000\t8.5460000\t520\t1\n"
                           "4\t0\t10\t16\t0\t0\t0\t0\t47.3970000\t8.5460000\t30\t0\n"
                           "5\t0\t2\t112\t5\t0\t0\t0\t0\t0\t0\t1\n"
                           "6\t0\t3\t18\t2\t0\t-40\t1\t47.3960000\t8.5460000\t30\t1\n"
                           "7\t0\t2\t177\t3\t2\t0\t0\t0\t0\t0\t1\n"
                           "8\t0\t3\t183\t9\t1500\t0\t0\t0.0000000\t0.0000000\t0\t1\n"
                           "9\t0\t3\t21\t15\t0\t0\t0\t0.0000000\t0.0000000\t0\t1\n";
  const auto read = import_waypoints(text);
  ASSERT_TRUE(read.has_value()) << read.error().message();
  EXPECT_EQ(std::get<jump>(read->mission.items.at(6)), (jump{"item-7", "item-3", 2}));
  const auto written = export_waypoints(read->mission);
  EXPECT_TRUE(written.losses.empty()) << written.losses.message();
  EXPECT_EQ(written.text, text);
}

TEST(waypoints_import, what_was_written_reads_back_but_for_surveys_and_fences) {
  document mission;
  mission.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  mission.planned_home = planned_home{47.5, 8.5, 488};
  mission.items = {takeoff{"item-1", 30}, waypoint{"item-2", {47.25, 8.125, 30.5}, 2, 3, {}},
                   loiter{"item-3", {47.25, -8.125, 30.5}, -20, 60}, change_speed{"item-4", 4.5},
                   land{"item-5", {47.5, 8.5, 0}}};
  const auto written = export_waypoints(mission);
  EXPECT_TRUE(written.losses.empty());
  const auto again = import_waypoints(written.text, {false, mission.mission_id});
  ASSERT_TRUE(again.has_value()) << again.error().message();
  EXPECT_EQ(export_waypoints(again->mission).text, written.text);
  mission.items.emplace_back(survey{"s", {{0, 0}, {0, 1}, {1, 0}}, 50, 20, {}});
  mission.geofences = {{fence_kind::inclusion, {{0, 0}, {0, 1}, {1, 0}}, {}, {}}};
  EXPECT_EQ(export_waypoints(mission).losses.message(),
            "item 5: the survey; a file of lines has no patterns; instead: left out\n"
            "geofence 1; a file of lines has no fences; instead: left out");
}

} // namespace waypoints_import_test
} // namespace godwit::mission
