#include "actors/domain/mission/convert/plan_import.hpp"

#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "actors/domain/mission/rules.hpp"
#include "tests/actors/domain/mission/sample_files.hpp"

namespace godwit::mission {
namespace plan_import_test {

document whole(const std::string& name) {
  const auto result = import_plan(sample_file(name));
  EXPECT_TRUE(result.has_value()) << result.error().message();
  return result ? result->mission : document{};
}

// What is taken when losses are allowed; that they are not allowed by default is looked at on the way.
imported partial(const std::string& name) {
  const auto refused = import_plan(sample_file(name));
  EXPECT_FALSE(refused.has_value()) << name;
  EXPECT_TRUE(!refused && refused.error().error.code == document_errc::lossy) << name;
  const auto result = import_plan(sample_file(name), {true, {}});
  EXPECT_TRUE(result.has_value()) << result.error().message();
  EXPECT_TRUE(!refused && result && refused.error().losses.all == result->losses.all) << name;
  return result ? *result : imported{};
}

conversion_error refused(const std::string& name) {
  const auto result = import_plan(sample_file(name), {true, {}});
  return result ? conversion_error{} : result.error();
}

std::string kinds(const document& mission) {
  std::string text;
  for (const auto& each : mission.items)
    text += (text.empty() ? "" : " ") + std::string(kind_of(each));
  return text;
}

TEST(plan_import, a_simple_plan_is_taken_whole) {
  const auto mission = whole("simple.plan");
  EXPECT_EQ(kinds(mission), "command change_speed waypoint waypoint loiter waypoint return");
  EXPECT_EQ(mission.planned_home, (planned_home{47.3977419, 8.5455938, 488.1}));
  EXPECT_EQ(std::get<command_item>(mission.items[0]).params[4], 47.3977419) << "a take-off has no place of its own";
  EXPECT_EQ(std::get<waypoint>(mission.items[3]), (waypoint{"item-4", {47.3991, 8.5472, 60}, 5, 3, {}}));
  EXPECT_EQ(std::get<loiter>(mission.items[4]), (loiter{"item-5", {47.3987, 8.5481, 55}, 25, 30}));
}

TEST(plan_import, the_same_file_always_gets_the_same_id_unless_one_is_given) {
  const auto text = sample_file("simple.plan");
  EXPECT_EQ(import_plan(text)->mission.mission_id, import_plan(text)->mission.mission_id);
  EXPECT_NE(import_plan(text)->mission.mission_id, import_plan(text + ' ')->mission.mission_id);
  const std::string id = "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42";
  EXPECT_EQ(import_plan(text, {false, id})->mission.mission_id, id);
  EXPECT_EQ(import_plan(text, {false, "x"}).error().error.code, document_errc::wrong_form);
}

TEST(plan_import, return_to_launch_stays_a_return_to_the_vehicles_home_and_the_planned_home_is_only_kept) {
  const auto mission = whole("home_elsewhere.plan");
  EXPECT_EQ(mission.items.back(), item(return_home{"item-3", return_goal::home}));
  EXPECT_EQ(mission.return_point, std::nullopt);
  EXPECT_EQ(mission.planned_home, (planned_home{47.399, 8.55, 488}));
}

TEST(plan_import, a_planned_home_at_0_0_is_no_home) {
  auto plan = nlohmann::json::parse(sample_file("home_elsewhere.plan"));
  plan["mission"]["plannedHomePosition"] = {0, 0, 0};
  const auto result = import_plan(plan.dump());
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.planned_home, std::nullopt);
  EXPECT_EQ(result->mission.items.size(), 3U);
}

// The one keeps the vehicle in and the other keeps it out: nobody guesses which of them is meant.
TEST(plan_import, a_fence_that_does_not_say_whether_it_keeps_in_or_out_is_refused_with_its_place) {
  EXPECT_EQ(refused("fence_without_inclusion.plan").message(),
            "/geoFence/polygons/0/inclusion is missing; allowed: true or false\n"
            "/geoFence/circles/0/inclusion is missing; allowed: true or false");
  auto plan = nlohmann::json::parse(sample_file("fence.plan"));
  for (const auto& other : {nlohmann::json("true"), nlohmann::json(1), nlohmann::json()}) {
    plan["geoFence"]["polygons"][1]["inclusion"] = other;
    EXPECT_EQ(import_plan(plan.dump(), {true, {}}).error().message(),
              "/geoFence/polygons/1/inclusion is of another type; allowed: true or false");
  }
}

TEST(plan_import, what_decides_about_the_flight_has_no_default) {
  auto plan = nlohmann::json::parse(sample_file("simple.plan"));
  plan["mission"].erase("firmwareType");
  plan["mission"]["items"][2].erase("autoContinue");
  EXPECT_EQ(import_plan(plan.dump(), {true, {}}).error().message(),
            "/mission/firmwareType is missing; allowed: a whole number up to 65535\n"
            "/mission/items/2/autoContinue is missing; allowed: true or false");
  plan = nlohmann::json::parse(sample_file("landing_pattern.plan"));
  plan["mission"]["items"][2].erase("altitudesAreRelative");
  EXPECT_EQ(import_plan(plan.dump(), {true, {}}).error().error.message(),
            "/mission/items/2/altitudesAreRelative is missing; allowed: true or false");
}

TEST(plan_import, a_whole_number_may_have_a_decimal_point) {
  auto plan = nlohmann::json::parse(sample_file("simple.plan"));
  plan["mission"]["items"][2]["command"] = 16.0;
  EXPECT_TRUE(import_plan(plan.dump()).has_value());
  for (const auto no_number : {16.5, 65'536.0, -70'000.0}) {
    plan["mission"]["items"][2]["command"] = no_number;
    EXPECT_FALSE(import_plan(plan.dump()).has_value()) << no_number;
  }
}

TEST(plan_import, null_is_not_given_and_a_landing_without_a_place_is_where_the_item_before_it_was) {
  const auto mission = whole("null_params.plan");
  EXPECT_EQ(kinds(mission), "takeoff waypoint land");
  EXPECT_EQ(std::get<land>(mission.items[2]).at, (position{47.3985, 8.5465, 0}));
}

TEST(plan_import, four_params_and_a_coordinate_are_seven_params_and_old_fences_without_content_are_no_loss) {
  const auto mission = whole("section.plan");
  EXPECT_EQ(kinds(mission), "command waypoint waypoint command waypoint");
  EXPECT_EQ(std::get<waypoint>(mission.items[2]), (waypoint{"item-3", {47.3989, 8.5487, 20}, 0, 0, {}}));
  EXPECT_EQ(std::get<command_item>(mission.items[3]).command, 205);
}

TEST(plan_import, an_old_fence_with_something_in_it_is_a_loss) {
  auto plan = nlohmann::json::parse(sample_file("simple.plan"));
  plan["geoFence"] = {{"version", 1}, {"polygon", {{47.1, 8.1}, {47.2, 8.1}, {47.2, 8.2}}}};
  EXPECT_EQ(import_plan(plan.dump()).error().losses.message(),
            "fence of version 1; its form is not known; instead: left out");
}

TEST(plan_import, a_plan_that_is_only_a_fence_is_no_mission_and_read_where_that_is_asked_for) {
  auto plan = nlohmann::json::parse(sample_file("fence.plan"));
  plan["mission"]["items"] = nlohmann::json::array();
  EXPECT_EQ(import_plan(plan.dump(), {true, {}}).error().message(),
            "the document holds a fence alone, which is no mission");
  const import_options alone{false, {}, {}, true};
  const auto result = import_plan(plan.dump(), alone);
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_TRUE(result->mission.items.empty());
  EXPECT_EQ(result->mission.geofences.size(), 2U);
  plan["geoFence"]["polygons"][1]["polygon"] = {{47.1, 8.1}, {47.2, 8.2}};
  EXPECT_EQ(import_plan(plan.dump(), alone).error().message(),
            "/geoFence/polygons/1/polygon is a list of 2; allowed: a polygon");
}

// What was lost is the mission itself: a fence is left, and nobody asked for that.
TEST(plan_import, a_plan_whose_items_are_all_left_out_is_no_fence_alone) {
  auto plan = nlohmann::json::parse(sample_file("fence.plan"));
  auto item = plan["mission"]["items"][0];
  item["command"] = 177;
  plan["mission"]["items"] = nlohmann::json::array({item});
  const auto result = import_plan(plan.dump(), {true, {}});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().error.message(), "/mission/items is a list of 0; allowed: a list of 1 to 10000 entries");
  EXPECT_NE(result.error().losses.message().find("DO_JUMP"), std::string::npos);
}

TEST(plan_import, a_ring_may_be_closed) {
  auto plan = nlohmann::json::parse(sample_file("fence.plan"));
  const auto open = import_plan(plan.dump());
  auto& ring = plan["geoFence"]["polygons"][0]["polygon"];
  ring.push_back(nlohmann::json(ring[0]));
  const auto closed = import_plan(plan.dump());
  ASSERT_TRUE(closed.has_value()) << closed.error().message();
  EXPECT_EQ(closed->mission.geofences, open->mission.geofences);
}

TEST(plan_import, what_is_wrong_with_a_fence_is_told_where_the_file_has_it) {
  auto plan = nlohmann::json::parse(sample_file("fence.plan"));
  auto& ring = plan["geoFence"]["polygons"][1]["polygon"];
  ring = {{47.38, 8.53}, {47.39, 8.53}, {47.38, 8.53}, {47.39, 8.53}};
  EXPECT_EQ(import_plan(plan.dump()).error().message(),
            "/geoFence/polygons/1/polygon has 2 different corners; allowed: at least 3 different corners");
}

TEST(plan_import, an_item_gets_a_kind_of_its_own_only_where_the_vehicle_gets_each_field_of_it) {
  auto plan = nlohmann::json::parse(sample_file("simple.plan"));
  auto& items = plan["mission"]["items"];
  const auto kind_at = [&](std::size_t n) {
    return std::string(kind_of(import_plan(plan.dump())->mission.items.at(n)));
  };
  auto& up = items[0]["params"];
  EXPECT_EQ(kind_at(0), "command") << "its place: godwit's own take-off climbs where the vehicle stands";
  up[4] = up[5] = nullptr;
  EXPECT_EQ(kind_at(0), "takeoff");
  up[0] = 15;
  EXPECT_EQ(kind_at(0), "command") << "its pitch, though no multirotor has one";
  auto& speed = items[1]["params"];
  speed[0] = 0;
  EXPECT_EQ(kind_at(1), "command") << "through the air";
  speed[0] = 1;
  speed[2] = 0;
  EXPECT_EQ(kind_at(1), "command") << "without throttle";
  plan["mission"]["firmwareType"] = 3;
  EXPECT_EQ(kind_at(3), "waypoint");
  EXPECT_EQ(kind_at(4), "loiter");
  items[3]["params"][0] = 2.5;
  EXPECT_EQ(kind_at(3), "command") << "an ArduPilot waits for whole seconds";
  items[3]["params"][0] = 2;
  plan["mission"]["vehicleType"] = 1;
  EXPECT_EQ(kind_at(3), "command") << "wings circle while they wait";
  EXPECT_EQ(kind_at(4), "command");
  EXPECT_EQ(kind_at(2), "waypoint");
}

TEST(plan_import, a_mission_that_needs_version_2_knows_for_which_vehicle_it_was_drawn) {
  EXPECT_EQ(whole("simple.plan").vehicle, vehicle_profile::px4_multicopter);
  EXPECT_EQ(whole("null_params.plan").vehicle, std::nullopt) << "of version 1, for what such a mission is written for";
  auto plan = nlohmann::json::parse(sample_file("null_params.plan"));
  plan["mission"]["firmwareType"] = 3;
  plan["mission"]["items"][2]["params"][4] = 47.3986;
  plan["mission"]["items"][2]["params"][5] = 8.5466;
  const auto mission = import_plan(plan.dump())->mission;
  EXPECT_EQ(mission.vehicle, vehicle_profile::arducopter);
  EXPECT_EQ(mission.schema_version, "2.0.0");
}

TEST(plan_import, what_the_vehicle_refuses_is_a_loss_and_what_it_passes_over_is_carried) {
  auto plan = nlohmann::json::parse(sample_file("simple.plan"));
  plan["mission"]["items"][2]["command"] = 82;
  const auto losses_for = [&](vehicle_profile vehicle) {
    const auto result = import_plan(plan.dump(), {true, {}, vehicle});
    return result ? result->losses.message() : result.error().message();
  };
  EXPECT_EQ(losses_for(vehicle_profile::px4_multicopter),
            "item 2: NAV_SPLINE_WAYPOINT: the item; a vehicle of the kind px4-multicopter refuses a mission with it; "
            "instead: left out");
  EXPECT_EQ(losses_for(vehicle_profile::ardurover), "");
  EXPECT_EQ(losses_for(vehicle_profile::arducopter), "");
}

TEST(plan_import, a_survey_at_one_height_becomes_a_survey) {
  const auto mission = whole("survey.plan");
  ASSERT_EQ(kinds(mission), "command survey return");
  const auto& area = std::get<survey>(mission.items[1]);
  EXPECT_EQ(area.polygon.size(), 4U);
  EXPECT_EQ(area.altitude_m, 50);
  EXPECT_EQ(area.line_spacing_m, 25);
  EXPECT_EQ(area.heading_deg, 30);
}

TEST(plan_import, a_survey_with_a_camera_is_its_lines_as_they_were_laid_triggers_and_turns_included) {
  const auto mission = whole("survey_camera.plan");
  EXPECT_EQ(kinds(mission), "command waypoint command waypoint command waypoint command waypoint command return");
  EXPECT_EQ(std::get<command_item>(mission.items[2]).command, 206);
}

TEST(plan_import, a_survey_that_can_not_be_one_becomes_the_lines_that_were_laid) {
  EXPECT_EQ(kinds(whole("survey_crossing.plan")), "command waypoint waypoint waypoint waypoint return");
}

TEST(plan_import, a_survey_without_its_lines_that_can_not_be_one_is_a_loss) {
  auto plan = nlohmann::json::parse(sample_file("survey_crossing.plan"));
  plan["mission"]["items"][1]["TransectStyleComplexItem"]["Items"] = nlohmann::json::array();
  EXPECT_EQ(import_plan(plan.dump()).error().losses.message(),
            "item 1: survey: its area; its area has edges 0 and 2 that cross or touch, and the file does not have its "
            "lines; instead: left out");
}

TEST(plan_import, heights_above_terrain_are_carried_as_they_are) {
  const auto mission = whole("survey_terrain.plan");
  EXPECT_EQ(kinds(mission), "command command command command command waypoint return");
  EXPECT_EQ(std::get<command_item>(mission.items[2]).frame, 10);
}

TEST(plan_import, a_corridor_becomes_its_lines) {
  EXPECT_EQ(kinds(whole("corridor.plan")), "command waypoint waypoint waypoint waypoint return");
}

TEST(plan_import, a_structure_scan_is_left_out) {
  const auto result = partial("structure.plan");
  EXPECT_EQ(kinds(result.mission), "command return");
  EXPECT_EQ(result.losses.message(),
            "item 1: the pattern \"StructureScan\"; a mission has no counterpart of it; instead: left out");
}

TEST(plan_import, a_landing_pattern_is_what_the_ground_station_lays_for_it) {
  const auto mission = whole("landing_pattern.plan");
  const auto numbers_of = [](const document& each) {
    std::string text;
    for (const auto& one : each.items)
      if (const auto* command = std::get_if<command_item>(&one))
        text += ' ' + std::to_string(command->command);
    return text;
  };
  ASSERT_EQ(numbers_of(mission), " 22 189 206 2001 2501 31 21");
  const auto& down = std::get<command_item>(mission.items.at(6));
  EXPECT_EQ(down.params[1], 75);
  EXPECT_EQ(down.params[4], 47.3979);
  EXPECT_EQ(down.params[6], 40);
  EXPECT_TRUE(numbers_of(whole("vtol_landing.plan")).ends_with(" 85"));
}

TEST(plan_import, gimbals_regions_of_interest_triggers_and_jumps_are_carried) {
  const auto mission = whole("ardupilot.plan");
  EXPECT_EQ(kinds(mission), "command command waypoint command waypoint command waypoint jump return");
  EXPECT_EQ(mission.schema_version, "2.0.0");
}

TEST(plan_import, a_yaw_of_0_is_north_for_px4_and_none_for_ardupilot) {
  auto plan = nlohmann::json::parse(sample_file("simple.plan"));
  plan["mission"]["items"][2]["params"][3] = 0;
  EXPECT_EQ(kind_of(import_plan(plan.dump())->mission.items.at(2)), "command");
  plan["mission"]["firmwareType"] = 3;
  EXPECT_EQ(kind_of(import_plan(plan.dump())->mission.items.at(2)), "waypoint");
}

TEST(plan_import, fences_of_polygons_are_taken_whole) {
  const auto mission = whole("fence.plan");
  ASSERT_EQ(mission.geofences.size(), 2U);
  EXPECT_EQ(mission.geofences[0].kind, fence_kind::inclusion);
  EXPECT_EQ(mission.geofences[1].kind, fence_kind::exclusion);
  EXPECT_EQ(mission.geofences[1].vertices[2], (vertex{47.3995, 8.5510}));
}

TEST(plan_import, circles_breach_points_and_rally_points_are_carried) {
  const auto mission = whole("fence_rally.plan");
  ASSERT_EQ(mission.geofences.size(), 2U);
  EXPECT_EQ(mission.geofences[1].vertices.size(), 32U) << "by which it is judged";
  ASSERT_TRUE(mission.geofences[1].circle);
  EXPECT_EQ(mission.geofences[1].circle->radius_m, 80);
  ASSERT_TRUE(mission.rally_points);
  EXPECT_EQ(mission.rally_points->size(), 2U);
  EXPECT_TRUE(mission.breach_return_point);
  EXPECT_EQ(mission.schema_version, "2.0.0");
}

TEST(plan_import, places_in_all_frames_with_latitude_and_longitude_are_carried_and_the_others_are_losses) {
  const auto result = partial("every_frame.plan");
  EXPECT_EQ(kinds(result.mission), "command command waypoint command waypoint command command return");
  EXPECT_EQ(result.losses.all.size(), 9U); // of 15 frames
}

// Those beside the mission say nothing of the flight: a UUID in plans of PX4's tests.
TEST(plan_import, properties_of_the_mission_that_are_not_known_are_losses) {
  EXPECT_EQ(partial("unknown_properties.plan").losses.message(),
            "item 1: property \"/mission/items/1/terrainMargin\"; the importer does not know it; instead: left out");
}

TEST(plan_import, another_version_is_refused_with_the_version_that_is_known) {
  EXPECT_EQ(refused("other_version.plan").message(), "/version is 2; allowed: 1");
  EXPECT_EQ(refused("other_mission_version.plan").message(), "/mission/version is 7; allowed: 1 or 2");
}

TEST(plan_import, items_of_the_first_form_are_read) {
  const auto mission = whole("old_items.plan");
  ASSERT_EQ(kinds(mission), "command waypoint");
  EXPECT_EQ(std::get<waypoint>(mission.items[1]).at, (position{47.3985, 8.5465, 50}));
  auto plan = nlohmann::json::parse(sample_file("old_items.plan"));
  plan["mission"]["version"] = 1;
  EXPECT_TRUE(import_plan(plan.dump()).has_value());
  plan["mission"]["items"][1]["param3"] = "none";
  EXPECT_EQ(import_plan(plan.dump()).error().message(),
            "/mission/items/1/param3 is of another type; allowed: a number\n"
            "/mission/items/1/param3 is of another type; allowed: a number or null");
}

TEST(plan_import, mission_files_from_before_there_were_plans_are_read) {
  const auto mission = whole("old_mission_file.json");
  EXPECT_EQ(kinds(mission), "command command command");
  EXPECT_EQ(mission.planned_home, (planned_home{47.3977419, 8.5455938, 0}));
  auto older = nlohmann::json::parse(sample_file("old_mission_file.json"));
  older["version"] = "1.0";
  older.erase("firmwareType");
  older["MAV_AUTOPILOT"] = 3;
  older["plannedHomePosition"] = {{"coordinate", {47.3977419, 8.5455938, 0}}, {"command", 16}};
  older["complexItems"] = nlohmann::json::array({nlohmann::json{{"version", "1.0"}}});
  const auto result = import_plan(older.dump(), {true, {}});
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.items.size(), 3U);
  EXPECT_EQ(result->losses.message(), "the pattern \"/complexItems/0\"; its form is not known; instead: left out");
}

TEST(plan_import, broken_plans_are_refused_with_each_place) {
  EXPECT_EQ(refused("no_plan.plan").message(), "/fileType is not \"Plan\"; allowed: a plan of QGroundControl");
  EXPECT_EQ(refused("cut_off.plan").error.code, document_errc::syntax);
  EXPECT_EQ(refused("no_items.plan").message(), "/mission/items is a list of 0; allowed: a list of 1 to 10000 entries");
  EXPECT_EQ(refused("off_earth.plan").message(),
            "/mission/items/1 (item 1, NAV_WAYPOINT, \"item-2\"): latitude is 95; allowed: a number from -90 to 90");
  EXPECT_EQ(refused("wrong_types.plan").message(),
            "/mission/plannedHomePosition is no place; allowed: [latitude, longitude] or [latitude, longitude, "
            "altitude]\n"
            "/mission/items/0/command is of another type; allowed: a whole number up to 65535\n"
            "/mission/items/1 has 3 params; allowed: 7, or 4 and a coordinate of 3\n"
            "/mission/items/2 has the type \"Item\"; allowed: \"SimpleItem\" or \"ComplexItem\"\n"
            "/mission/items/3/params/2 is of another type; allowed: a number or null");
}

TEST(plan_import, every_sample_is_taken_or_refused_with_a_reason) {
  std::size_t samples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(GODWIT_TEST_DATA) + "/missions")) {
    if (entry.path().extension() != ".plan")
      continue;
    ++samples;
    const auto result = import_plan(sample_file(entry.path().filename()), {true, {}});
    if (result)
      EXPECT_TRUE(broken_rules(result->mission).empty()) << entry.path();
    else
      EXPECT_FALSE(result.error().message().empty()) << entry.path();
  }
  EXPECT_GE(samples, 20U);
}

TEST(plan_import, lists_are_bounded) {
  auto plan = nlohmann::json::parse(sample_file("simple.plan"));
  plan["mission"]["items"] = nlohmann::json::array();
  for (int i = 0; i <= 20'000; ++i)
    plan["mission"]["items"].push_back(i);
  EXPECT_EQ(import_plan(plan.dump()).error().message(), "/mission/items is a list of 20001; allowed: up to 20000");
}

TEST(plan_import, nesting_is_bounded_however_deep_it_is) {
  EXPECT_FALSE(import_plan(R"({"fileType":)" + std::string(500'000, '[')).has_value());
}

} // namespace plan_import_test
} // namespace godwit::mission
