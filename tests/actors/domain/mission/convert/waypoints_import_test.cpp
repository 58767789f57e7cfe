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
  EXPECT_EQ(std::get<takeoff>(mission.items[0]).altitude_m, 20);
  EXPECT_EQ(std::get<change_speed>(mission.items[1]).mps, 6);
  EXPECT_EQ(std::get<loiter>(mission.items[3]).duration_s, 15);
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
                           "1\t0\t3\t206\t20\t0\t0\t0\t0\t0\t0\t1\n"
                           "2\t0\t3\t16\t-5\t0\t0\t0\t47.398\t8.546\t20\t1\n";
  const auto result = import_waypoints(text, {true, {}});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().error.message(),
            "line 6 (item 2, NAV_WAYPOINT, \"item-1\"): hold_s is -5; allowed: a number from 0 to 86400");
  EXPECT_EQ(result.error().losses.message(), "item 1 (line 5): DO_SET_CAM_TRIGG_DIST: the item; a mission has no "
                                             "commands for cameras and gimbals; instead: left out");
}

TEST(waypoints_import, lines_whose_items_are_all_left_out_are_refused_whatever_is_allowed) {
  const auto result = import_waypoints("QGC WPL 110\n0\t0\t2\t177\t0\t3\t0\t0\t0\t0\t0\t1\n", {true, {}});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().message(), "the document holds no item that a mission has\n"
                                      "item 0 (line 2): DO_JUMP: the item; the items of a mission are flown once, in "
                                      "order; instead: left out");
}

TEST(waypoints_import, a_home_of_command_0_is_home) {
  const auto result = import_waypoints("QGC WPL 110\n"
                                       "0\t1\t0\t0\t0\t0\t0\t0\t47.399\t8.55\t488\t1\n"
                                       "1\t0\t3\t16\t0\t0\t0\t0\t47.398\t8.546\t20\t1\n");
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.planned_home, (planned_home{47.399, 8.55, 488}));
}

TEST(waypoints_import, a_fence_is_read_as_a_fence_with_its_point_of_return_as_a_loss) {
  const std::string fence = "47.398\t8.546\n47.397\t8.545\n47.399\t8.545\n47.399\t8.547\n47.397\t8.545\n";
  const import_options alone{true, {}, {}, true};
  const auto result = import_waypoints(fence, alone);
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_TRUE(result->mission.items.empty());
  ASSERT_EQ(result->mission.geofences.size(), 1U);
  EXPECT_EQ(result->mission.geofences[0].vertices.size(), 3U);
  EXPECT_EQ(result->losses.message(), "item 0 (line 1): point to return to after a breach; a mission returns to one "
                                      "point; instead: left out");
  EXPECT_EQ(import_waypoints(fence, {true, {}}).error().error.message(),
            "the document holds a fence alone, which is no mission");
  const auto crossing = import_waypoints("0 0\n47 8\n48 9\n47 9\n48 8\n", alone);
  EXPECT_EQ(crossing.error().error.problems.at(0).pointer, "line 2");
}

TEST(waypoints_import, rally_points_alone_are_refused_with_what_brings_them) {
  const auto* const expected = "the document holds rally points alone, and a mission has none; godwit-trace upload "
                               "--type rally brings them to the vehicle";
  EXPECT_EQ(import_waypoints("RALLY 47.398 8.546 60 40 0 0\n", {true, {}}).error().message(), expected);
  EXPECT_EQ(import_waypoints("QGC WPL 110\n0\t0\t3\t5100\t0\t0\t0\t0\t47.398\t8.546\t60\t1\n").error().message(),
            expected);
}

TEST(waypoints_import, who_is_to_fly_it_decides_what_is_lost) {
  const std::string text = "QGC WPL 110\n"
                           "0\t1\t0\t16\t0\t0\t0\t0\t47.399\t8.55\t488\t1\n"
                           "1\t0\t3\t22\t15\t0\t0\t30\t47.39\t8.54\t20\t1\n"
                           "2\t0\t3\t16\t0\t0\t3\t90\t47.398\t8.546\t20\t1\n";
  const auto losses_for = [&](std::optional<vehicle_profile> vehicle) {
    return import_waypoints(text, {true, {}, vehicle})->losses.all.size();
  };
  EXPECT_EQ(losses_for({}), 5U);
  EXPECT_EQ(losses_for(vehicle_profile::arducopter), 0U);
  EXPECT_EQ(losses_for(vehicle_profile::arduplane), 3U) << "pitch, place of the take-off, pass radius";
  EXPECT_EQ(losses_for(vehicle_profile::px4_multicopter), 4U) << "two yaws, place of the take-off, pass radius";
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
  EXPECT_EQ(again->mission, mission);
  mission.items.emplace_back(survey{"s", {{0, 0}, {0, 1}, {1, 0}}, 50, 20, {}});
  mission.geofences = {{fence_kind::inclusion, {{0, 0}, {0, 1}, {1, 0}}, {}, {}}};
  EXPECT_EQ(export_waypoints(mission).losses.message(),
            "item 5: the survey; a file of lines has no patterns; instead: left out\n"
            "geofence 1; a file of lines has no fences; instead: left out");
}

} // namespace waypoints_import_test
} // namespace godwit::mission
