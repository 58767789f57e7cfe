#include "actors/domain/mission/convert/convert.hpp"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include "actors/domain/mission/write.hpp"
#include "tests/actors/domain/mission/mission_maker.hpp"
#include "tests/actors/domain/mission/sample_files.hpp"

namespace godwit::mission {
namespace convert_test {

TEST(convert, the_format_is_known_by_the_ending_of_the_name) {
  EXPECT_EQ(format_of_name("a/b.plan"), mission_format::plan);
  EXPECT_EQ(format_of_name("b.geojson"), mission_format::geojson);
  EXPECT_EQ(format_of_name("b.json"), mission_format::json);
  EXPECT_EQ(format_of_name("b.waypoints"), mission_format::waypoints);
  EXPECT_EQ(format_of_name("B.PLAN"), mission_format::plan);
  EXPECT_EQ(format_of_name("old.mission"), mission_format::plan);
  EXPECT_EQ(format_of_name("field.fen"), mission_format::waypoints);
  EXPECT_EQ(format_of_name("b.kmz"), std::nullopt);
  EXPECT_EQ(format_of_name("plan"), std::nullopt);
}

TEST(convert, a_plan_goes_through_our_format_and_back_without_a_change) {
  const auto ours = convert(sample_file("survey.plan"), mission_format::plan, mission_format::json);
  ASSERT_TRUE(ours.has_value()) << ours.error().message();
  const auto plan = convert(ours->text, mission_format::json, mission_format::plan);
  ASSERT_TRUE(plan.has_value()) << plan.error().message();
  const auto id = import_mission(ours->text, mission_format::json)->mission.mission_id;
  const auto again = convert(plan->text, mission_format::plan, mission_format::json, {false, id});
  ASSERT_TRUE(again.has_value()) << again.error().message();
  EXPECT_EQ(again->text, ours->text);
}

// What a newer ground station has written is not understood, and not lost.
TEST(convert, a_plan_that_is_written_as_a_plan_keeps_all_that_is_in_it) {
  auto plan = nlohmann::json::parse(sample_file("survey_camera.plan"));
  plan["mission"]["items"][0]["newer"] = {{"a", 1}};
  plan["mission"]["cruiseSpeed"] = 17;
  const auto again = convert(plan.dump(), mission_format::plan, mission_format::plan);
  ASSERT_TRUE(again.has_value()) << again.error().message();
  EXPECT_EQ(nlohmann::json::parse(again->text), plan);
  EXPECT_FALSE(convert(plan.dump(), mission_format::plan, mission_format::json).has_value()) << "another form loses it";
  plan["mission"]["items"][1]["complexItemType"] = "Newer";
  const auto partial = convert(plan.dump(), mission_format::plan, mission_format::plan, {true, {}});
  ASSERT_TRUE(partial.has_value()) << partial.error().message();
  EXPECT_EQ(partial->losses.all.size(), 2U) << "what is left out, and what is not understood in the rest";
}

TEST(convert, an_older_form_of_a_plan_is_written_in_the_newer_one) {
  const auto again = convert(sample_file("old_mission_file.json"), mission_format::plan, mission_format::plan);
  ASSERT_TRUE(again.has_value()) << again.error().message();
  EXPECT_EQ(nlohmann::json::parse(again->text)["mission"]["version"], 2);
}

TEST(convert, the_vehicle_of_a_plan_comes_back_from_our_format) {
  constexpr std::pair<int, int> vehicles[] = {{3, 1}, {3, 2}, {3, 10}, {3, 20}, {12, 1}, {12, 2}, {12, 10}, {12, 20}};
  auto plan = nlohmann::json::parse(sample_file("simple.plan"));
  for (const auto& [firmware, type] : vehicles) {
    plan["mission"]["firmwareType"] = firmware;
    plan["mission"]["vehicleType"] = type;
    const auto ours = convert(plan.dump(), mission_format::plan, mission_format::json);
    ASSERT_TRUE(ours.has_value()) << ours.error().message();
    for (const auto by : {mission_format::json, mission_format::geojson}) {
      const auto between = convert(ours->text, mission_format::json, by);
      const auto head = nlohmann::json::parse(convert(between->text, by, mission_format::plan)->text)["mission"];
      EXPECT_EQ(head["firmwareType"], firmware);
      EXPECT_EQ(head["vehicleType"], type);
    }
  }
}

TEST(convert, what_is_lost_on_either_way_is_an_error_unless_it_is_allowed) {
  const auto refused = convert(sample_file("every_kind.json"), mission_format::json, mission_format::waypoints);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().message(), "the document can only be taken over in part: 3 losses\n"
                                       "item 3: the survey; a file of lines has no patterns; instead: left out\n"
                                       "geofence 1; a file of lines has no fences; instead: left out\n"
                                       "geofence 2; a file of lines has no fences; instead: left out");
  const auto allowed =
      convert(sample_file("every_kind.json"), mission_format::json, mission_format::waypoints, {true, {}});
  ASSERT_TRUE(allowed.has_value());
  EXPECT_EQ(allowed->losses.all.size(), 3U);
}

TEST(convert, a_fence_alone_is_written_where_a_fence_alone_can_stand) {
  const std::string fence = "QGC WPL 110\n"
                            "0\t0\t0\t5001\t3\t0\t0\t0\t47.1\t8.1\t0\t1\n"
                            "1\t0\t0\t5001\t3\t0\t0\t0\t47.2\t8.1\t0\t1\n"
                            "2\t0\t0\t5001\t3\t0\t0\t0\t47.2\t8.2\t0\t1\n";
  const auto plan = convert(fence, mission_format::waypoints, mission_format::plan);
  ASSERT_TRUE(plan.has_value()) << plan.error().message();
  const auto lines = convert(plan->text, mission_format::plan, mission_format::waypoints);
  ASSERT_TRUE(lines.has_value()) << lines.error().message();
  const import_options alone{false, {}, {}, true};
  const auto again = import_mission(lines->text, mission_format::waypoints, alone);
  ASSERT_TRUE(again.has_value()) << again.error().message();
  EXPECT_EQ(again->mission.geofences, import_mission(fence, mission_format::waypoints, alone)->mission.geofences);
  EXPECT_TRUE(again->mission.items.empty());
  EXPECT_EQ(convert(fence, mission_format::waypoints, mission_format::json).error().message(),
            "the document holds a fence alone, which is no mission; allowed: a .plan or .waypoints to write it to");
}

// An empty mission would be written, with home alone in it.
TEST(convert, surveys_alone_are_not_written_as_lines_whatever_is_allowed) {
  document mission;
  mission.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  mission.items = {survey{"s", {{47, 8}, {47, 8.01}, {47.01, 8}}, 50, 20, {}}};
  const auto text = export_mission(mission, mission_format::json).text;
  const auto result = convert(text, mission_format::json, mission_format::waypoints, {true, {}});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().message(), "the document has surveys alone, and lines have no patterns: nothing would be "
                                      "left; allowed: a .plan or .json");
}

// By way of our own form as well: nothing turns it into a flight to the planned home.
TEST(convert, the_camera_of_a_survey_keeps_what_a_plan_can_say) {
  document mission;
  mission.mission_id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  mission.schema_version = schema_version_2;
  survey area{"s", {{47, 8}, {47, 8.01}, {47.01, 8}}, 50, 20, 90.0, survey_camera{{12.5, {}}, -90.0, 30}};
  mission.items = {area};
  auto plan = export_mission(mission, mission_format::plan);
  ASSERT_EQ(plan.losses.all.size(), 1U) << plan.losses.message();
  EXPECT_EQ(plan.losses.all[0].what, "the survey: the pitch of the gimbal");
  const auto again = import_mission(plan.text, mission_format::plan);
  ASSERT_TRUE(again) << again.error().message();
  area.camera->gimbal_pitch_deg.reset();
  EXPECT_EQ(std::get<survey>(again->mission.items.at(0)).camera, area.camera);

  area.camera->trigger = {std::nullopt, 2.0};
  mission.items = {area};
  plan = export_mission(mission, mission_format::plan);
  ASSERT_EQ(plan.losses.all.size(), 1U) << plan.losses.message();
  EXPECT_EQ(plan.losses.all[0].what, "the survey: pictures by time");
}

TEST(convert, return_to_launch_of_a_plan_stays_one_on_its_way_through_our_format) {
  const auto ours = convert(sample_file("home_elsewhere.plan"), mission_format::plan, mission_format::json);
  ASSERT_TRUE(ours.has_value()) << ours.error().message();
  const auto mission = import_mission(ours->text, mission_format::json)->mission;
  EXPECT_EQ(mission.items.back(), item(return_home{"item-3", return_goal::home}));
  EXPECT_EQ(mission.planned_home, (planned_home{47.399, 8.55, 488}));
  const auto plan = nlohmann::json::parse(convert(ours->text, mission_format::json, mission_format::plan)->text);
  EXPECT_EQ(plan["mission"]["items"].back()["command"], 20);
  EXPECT_EQ(plan["mission"]["plannedHomePosition"], nlohmann::json({47.399, 8.55, 488.0}));
}

TEST(convert, heights_of_fences_have_no_place_in_a_plan) {
  const auto refused = convert(sample_file("every_kind.json"), mission_format::json, mission_format::plan);
  EXPECT_EQ(refused.error().losses.message(),
            "geofence 1: floor and ceiling; the fences of a plan have no heights; instead: left out");
}

TEST(convert, latitude_0_and_longitude_0_can_not_be_said_to_a_vehicle) {
  document mission;
  mission.items = {waypoint{"w", {0, 0, 20}, 0, 0, {}}, land{"l", {0, 1, 0}}};
  const auto expected = "item 0: NAV_WAYPOINT: place 0/0; vehicles take it for no place; instead: written all the same";
  EXPECT_EQ(export_mission(mission, mission_format::plan).losses.message(), expected);
  EXPECT_EQ(export_mission(mission, mission_format::waypoints).losses.message(), expected);
}

TEST(convert, the_list_of_losses_is_bounded_and_says_that_there_are_more) {
  loss_list losses;
  for (std::size_t i = 0; i < max_losses + 5; ++i)
    losses.add({i, "a", "b", "c"});
  EXPECT_EQ(losses.all.size(), max_losses);
  EXPECT_TRUE(losses.message().ends_with("and 5 further losses"));
}

// What a plan can say: returns to the home of the vehicle, a planned home with a height, no heights of fences, a speed
// as an item of its own, a survey with a heading and pictures by distance, no change of ids. Commands are for an
// ArduPilot, which waits for whole seconds.
document plan_like(document mission) {
  if (needs_version_2(mission))
    mission.vehicle = vehicle_profile::arducopter;
  mission.return_point.reset();
  if (mission.planned_home)
    mission.planned_home->above_sea_m = mission.planned_home->above_sea_m.value_or(0);
  mission.revision = 1;
  for (auto& each : mission.geofences) {
    each.floor_m.reset();
    each.ceiling_m.reset();
  }
  for (auto& each : mission.items) {
    if (auto* back = std::get_if<return_home>(&each))
      back->to = return_goal::home;
    if (auto* point = std::get_if<waypoint>(&each)) {
      point->speed_mps.reset();
      point->hold_s = std::round(point->hold_s);
    }
    if (auto* stay = std::get_if<loiter>(&each))
      stay->duration_s = std::round(stay->duration_s);
    if (auto* area = std::get_if<survey>(&each)) {
      area->heading_deg = area->heading_deg.value_or(0);
      if (area->camera) {
        area->camera->trigger = {area->camera->trigger.distance_m.value_or(1), std::nullopt};
        area->camera->gimbal_pitch_deg.reset();
      }
    }
  }
  return mission;
}

RC_GTEST_PROP(convert_property, a_mission_that_a_plan_can_say_comes_back_from_it, ()) {
  const auto mission = plan_like(mission_maker(*rc::gen::arbitrary<std::uint64_t>()).mission());
  const auto plan = export_mission(mission, mission_format::plan);
  RC_ASSERT(plan.losses.empty());
  const auto again = import_mission(plan.text, mission_format::plan, {false, mission.mission_id});
  if (!again)
    RC_FAIL(again.error().message());
  auto expected = mission;
  for (auto& each : expected.items) // an angle may change its last digit on its way
    if (auto* area = std::get_if<survey>(&each)) {
      const auto& found =
          std::get<survey>(again->mission.items.at(static_cast<std::size_t>(&each - expected.items.data())));
      RC_ASSERT(std::abs(*found.heading_deg - *area->heading_deg) < 1e-9);
      area->heading_deg = found.heading_deg;
    }
  RC_ASSERT(again->mission == expected);
}

RC_GTEST_PROP(convert_property, our_format_comes_back_digit_for_digit, ()) {
  const auto mission = mission_maker(*rc::gen::arbitrary<std::uint64_t>()).mission();
  const auto text = export_mission(mission, mission_format::json).text;
  RC_ASSERT(import_mission(text, mission_format::json).value().mission == mission);
}

RC_GTEST_PROP(convert_property, a_damaged_file_never_crashes_an_importer, ()) {
  constexpr mission_format formats[] = {mission_format::json, mission_format::plan, mission_format::waypoints,
                                        mission_format::geojson};
  const auto mission = mission_maker(*rc::gen::arbitrary<std::uint64_t>()).mission(4);
  for (const auto format : formats) {
    auto text = export_mission(mission, format).text;
    for (int i = *rc::gen::inRange(1, 4); i > 0; --i)
      text[*rc::gen::inRange<std::size_t>(0, text.size())] = *rc::gen::arbitrary<char>();
    const auto result = import_mission(text, format, {true, {}});
    if (!result)
      RC_ASSERT(!result.error().message().empty());
  }
}

} // namespace convert_test
} // namespace godwit::mission
