#include "actors/domain/mission/read.hpp"

#include <gtest/gtest.h>

#include "actors/domain/mission/write.hpp"
#include "tests/actors/domain/mission/sample_files.hpp"

namespace godwit::mission {
namespace read_test {

using nlohmann::json;

json valid() { return json::parse(sample_file("every_kind.json")); }

document_error error_of(const json& mission) {
  const auto result = read<document>(mission.dump());
  return result ? document_error{} : result.error();
}

// VALID with VALUE at POINTER.
json with(const char* pointer, const json& value) {
  auto mission = valid();
  mission[json::json_pointer(pointer)] = value;
  return mission;
}

TEST(read_mission, each_kind_of_item_is_read) {
  const auto mission = read<document>(sample_file("every_kind.json"));
  ASSERT_TRUE(mission.has_value()) << mission.error().message();
  EXPECT_EQ(mission->revision, 3);
  ASSERT_EQ(mission->items.size(), 7U);
  EXPECT_EQ(std::get<waypoint>(mission->items[2]).speed_mps, 8);
  EXPECT_EQ(std::get<survey>(mission->items[3]).polygon.size(), 4U);
  EXPECT_EQ(mission->geofences.at(1).kind, fence_kind::exclusion);
  EXPECT_EQ(mission->geofences.at(1).floor_m, std::nullopt);
}

TEST(read_mission, the_revision_is_1_when_it_is_absent) {
  auto mission = valid();
  mission.erase("revision");
  EXPECT_EQ(read<document>(mission.dump())->revision, 1);
}

struct wrong_case {
  const char* pointer;
  json value;
  document_errc code;
  const char* message;
};

TEST(read_mission, what_is_wrong_is_said_with_its_place_and_what_is_allowed) {
  const auto form = document_errc::wrong_form;
  const auto rule = document_errc::broken_rule;
  const wrong_case cases[] = {
      {"/items/2/at/latitude", 95, form, "/items/2/at/latitude is 95; allowed: a number from -90 to 90"},
      {"/items/2/at/longitude", nullptr, form, "/items/2/at/longitude is null; allowed: a number from -180 to 180"},
      {"/items/2/speed_mps", 0, form, "/items/2/speed_mps is 0; allowed: a number above 0 up to 500"},
      {"/items/1/mps", -1, form, "/items/1/mps is -1; allowed: a number above 0 up to 500"},
      {"/items/0/kind", "hover", form,
       "/items/0/kind is \"hover\"; allowed: \"takeoff\", \"waypoint\", \"loiter\", \"change_speed\", \"survey\", "
       "\"land\", \"return\", \"command\" or \"jump\""},
      {"/items/0/altitude", 4, form,
       "/items/0/altitude is not known; did you mean altitude_m?; allowed: altitude_m, id, kind"},
      {"/items/3/heading_deg", 360, form, "/items/3/heading_deg is 360; allowed: a number from 0 below 360"},
      {"/items", json::array(), form, "/items is a list of 0; allowed: a list of 1 to 10000 entries"},
      {"/mission_id", "7D1C1F0E-6b0c-4c55-9d0d-2f6d3c8b1a42", form,
       "/mission_id is \"7D1C1F0E-6b0c-4c55-9d0d-2f6d3c8b1a42\"; allowed: a UUID in lower case, such as "
       "7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42"},
      {"/revision", 0, form, "/revision is 0; allowed: a whole number from 1 to 2147483647"},
      {"/pilot", "me", form,
       "/pilot is not known; allowed: breach_return_point, geofences, items, mission_id, planned_home, rally_points, "
       "return_point, revision, schema_version, vehicle"},
      {"/geofences/0/kind", "inclusion", form,
       "/geofences/0/kind is \"inclusion\"; allowed: \"INCLUSION\" or \"EXCLUSION\""},
      {"/items/5/id", "up", rule, "/items/5/id is \"up\", as of item 0; allowed: an id that no other item has"},
      {"/geofences/0/floor_m", 120, rule,
       "/geofences/0/floor_m is not below ceiling_m; allowed: a floor below the ceiling"},
      {"/geofences/1/vertices/2",
       {{"latitude", 47.399}, {"longitude", 8.55}},
       rule,
       "/geofences/1/vertices has 2 different corners; allowed: at least 3 different corners"},
      {"/items/3/polygon/1",
       {{"latitude", 47.3985}, {"longitude", 8.5456}},
       rule,
       "/items/3/polygon has edges 1 and 3 that cross or touch; allowed: at least 3 different corners, edges that do "
       "not cross or touch"},
      {"/schema_version", "3.0.0", document_errc::other_version,
       "/schema_version is \"3.0.0\"; allowed: versions 1.x.y and 2.x.y"},
      {"/schema_version", "1.0", form, "/schema_version is \"1.0\"; allowed: a version such as 1.0.0"},
  };
  for (const auto& each : cases) {
    const auto error = error_of(with(each.pointer, each.value));
    EXPECT_EQ(error.message(), each.message);
    EXPECT_EQ(error.code, each.code) << each.message;
  }
}

TEST(read_mission, another_minor_version_is_read) {
  EXPECT_TRUE(read<document>(with("/schema_version", "1.7.2").dump()).has_value());
}

TEST(read_mission, the_version_is_told_before_the_form_because_the_form_may_have_changed) {
  EXPECT_EQ(error_of({{"schema_version", "3.1.0"}, {"steps", 5}}).code, document_errc::other_version);
}

TEST(read_mission, a_missing_property_is_named) {
  auto mission = valid();
  mission.erase("geofences");
  mission["items"][2].erase("hold_s");
  EXPECT_EQ(error_of(mission).message(), "/geofences is missing; allowed: a list of up to 100 entries\n"
                                         "/items/2/hold_s is missing; allowed: a number from 0 to 86400");
}

TEST(read_mission, a_return_needs_a_return_point_unless_it_leads_home) {
  auto mission = valid();
  mission.erase("return_point");
  EXPECT_EQ(error_of(mission).message(), "/return_point is missing; allowed: a position: an item returns there");
  for (auto& each : mission["items"])
    if (each["kind"] == "return")
      each["to"] = "HOME";
  EXPECT_TRUE(read<document>(mission.dump()).has_value());
  mission["items"].back()["to"] = "home";
  EXPECT_FALSE(read<document>(mission.dump()).has_value());
}

TEST(read_mission, an_item_without_a_kind_is_not_judged_as_each_kind) {
  auto mission = valid();
  mission["items"][2].erase("kind");
  EXPECT_EQ(error_of(mission).problems.size(), 1U);
}

TEST(read_mission, what_is_no_object_is_refused) {
  EXPECT_EQ(error_of(json::array({1})).message(), "the document is a list of 1; allowed: a mission");
  EXPECT_EQ(error_of(nullptr).code, document_errc::wrong_form);
}

TEST(read_mission, a_whole_number_with_a_decimal_point_is_no_revision) {
  EXPECT_FALSE(read<document>(with("/revision", 1.5).dump()).has_value());
  EXPECT_FALSE(read<document>(with("/revision", 3.0).dump()).has_value());
}

TEST(read_mission, a_number_beyond_64_bits_is_never_read_as_a_small_one) {
  for (const auto number : {18'446'744'073'709'551'615U, 9'223'372'036'854'775'808U})
    EXPECT_FALSE(read<document>(with("/return_point/latitude", number).dump()).has_value()) << number;
}

TEST(read_map, a_wrong_row_of_a_page_is_named_and_the_page_is_refused_as_a_whole) {
  const json row{{"object_id", "c0a8f5d2-9c1e-4b0f-8a6d-1d2e3f405162"},
                 {"class_group", "vehicle"},
                 {"latitude", 47.5},
                 {"longitude", 8.5},
                 {"confidence", 0.5},
                 {"first_seen", "2026-05-01T08:00:00Z"},
                 {"last_seen", "2026-05-03T16:20:00Z"}};
  json page{{"schema_version", "1.0.0"}, {"map_objects", {row}}};
  EXPECT_TRUE(read<map_object_page>(page.dump()).has_value());
  auto wrong = row;
  wrong["object_id"] = "c0a8f5d2-9c1e-4b0f-8a6d-1d2e3f405163";
  wrong["confidence"] = 1.5;
  page["map_objects"].push_back(wrong);
  EXPECT_EQ(read<map_object_page>(page.dump()).error().message(),
            "/map_objects/1/confidence is 1.5; allowed: a number from 0 to 1");
}

TEST(read_mission, at_most_10000_items) {
  document mission = *read<document>(sample_file("every_kind.json"));
  mission.items.clear();
  for (int i = 0; i <= 10'000; ++i)
    mission.items.emplace_back(change_speed{std::to_string(i), 5});
  EXPECT_EQ(read<document>(to_text(mission)).error().code, document_errc::wrong_form);
  mission.items.pop_back();
  EXPECT_TRUE(read<document>(to_text(mission)).has_value());
}

TEST(read_mission, at_most_20000_corners_so_that_judging_them_ends) {
  auto mission = *read<document>(sample_file("every_kind.json"));
  auto area = std::get<survey>(mission.items[3]);
  for (int i = 0; i < 5000; ++i) {
    area.id = "area " + std::to_string(i);
    mission.items.emplace_back(area);
  }
  EXPECT_EQ(read<document>(to_text(mission)).error().message(),
            "/items have polygons with 20004 corners in all; allowed: up to 20000");
}

TEST(read_mission, the_list_of_problems_is_bounded_and_says_that_there_are_more) {
  auto mission = valid();
  for (int i = 0; i < 100; ++i)
    mission["unknown" + std::to_string(i)] = i;
  const auto error = error_of(mission);
  EXPECT_EQ(error.problems.size(), max_document_problems);
  EXPECT_GT(error.omitted, 0U);
}

TEST(read_mission, the_first_kibibyte_of_the_body_is_kept) {
  const auto text = with("/revision", 0).dump();
  const auto result = read<document>(text);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().sample, text.substr(0, 1024));
}

} // namespace read_test
} // namespace godwit::mission
