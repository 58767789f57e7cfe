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
