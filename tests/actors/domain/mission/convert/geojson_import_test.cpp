#include "actors/domain/mission/convert/geojson_import.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include "actors/domain/mission/convert/geojson_export.hpp"
#include "actors/domain/mission/polygon_rules.hpp"
#include "actors/domain/mission/read.hpp"
#include "tests/actors/domain/mission/mission_maker.hpp"
#include "tests/actors/domain/mission/sample_files.hpp"

namespace godwit::mission {
namespace geojson_import_test {

using nlohmann::json;

document sample() { return *read<document>(sample_file("every_kind.json")); }

TEST(geojson_import, what_was_exported_is_read_back_whole) {
  auto mission = sample();
  const auto again = import_geojson(export_geojson(mission).text);
  ASSERT_TRUE(again.has_value()) << again.error().message();
  // The rings of GeoJSON are counter-clockwise; two polygons of the sample are not.
  std::reverse(std::get<survey>(mission.items[3]).polygon.begin() + 1,
               std::get<survey>(mission.items[3]).polygon.end());
  for (auto& each : mission.geofences)
    if (signed_area(each.vertices) < 0)
      std::reverse(each.vertices.begin() + 1, each.vertices.end());
  EXPECT_EQ(again->mission, mission);
}

TEST(geojson_import, a_geometry_that_was_moved_on_a_map_counts) {
  auto map = json::parse(export_geojson(sample()).text);
  map["features"][2]["geometry"]["coordinates"] = {8.6, 47.6, 70};
  const auto again = import_geojson(map.dump());
  ASSERT_TRUE(again.has_value()) << again.error().message();
  EXPECT_EQ(std::get<waypoint>(again->mission.items[2]).at, (position{47.6, 8.6, 70}));
}

TEST(geojson_import, positions_have_the_longitude_first_and_rings_are_closed) {
  const auto map = json::parse(export_geojson(sample()).text);
  EXPECT_EQ(map["features"][2]["geometry"]["coordinates"], json({8.5465, 47.3985, 40}));
  const auto& ring = map["features"][3]["geometry"]["coordinates"][0];
  EXPECT_EQ(ring.size(), 5U);
  EXPECT_EQ(ring.front(), ring.back());
}

TEST(geojson_import, geojson_that_is_no_mission_is_refused_with_the_reason) {
  const auto message = [](const json& map) { return import_geojson(map.dump()).error().message(); };
  EXPECT_EQ(message({{"type", "FeatureCollection"}, {"features", json::array()}}),
            "the document is no GeoJSON of a mission; allowed: a FeatureCollection with `godwit` in it");
  auto map = json::parse(export_geojson(sample()).text);
  map["features"][0]["properties"]["role"] = "house";
  EXPECT_EQ(message(map), "/features/0/properties/role is \"house\"; allowed: item, geofence, return_point, "
                          "planned_home, breach_return_point, rally_point or path");
  map = json::parse(export_geojson(sample()).text);
  map["features"][2]["geometry"]["coordinates"][1] = 95;
  EXPECT_EQ(message(map), "/features/2 (\"corner\"): latitude is 95; allowed: a number from -90 to 90");
  map["features"][2]["geometry"] = {{"type", "LineString"}, {"coordinates", json::array()}};
  EXPECT_FALSE(import_geojson(map.dump()).has_value());
}

// A geographic information system gives each feature each column, colours and numbers of its own.
TEST(geojson_import, what_a_map_adds_is_passed_over) {
  const auto plain = import_geojson(export_geojson(sample()).text);
  auto map = json::parse(export_geojson(sample()).text);
  for (auto& each : map["features"]) {
    auto& properties = each["properties"];
    properties["fid"] = 7;
    properties["marker-color"] = "#ff0000";
    for (const auto* column : {"hold_s", "speed_mps", "heading_deg", "ceiling_m", "to", "note"})
      if (!properties.contains(column))
        properties[column] = nullptr;
  }
  const auto result = import_geojson(map.dump());
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission, plain->mission);
}

TEST(geojson_import, a_height_that_the_map_has_dropped_is_named) {
  auto map = json::parse(export_geojson(sample()).text);
  map["features"][2]["geometry"]["coordinates"].erase(2);
  EXPECT_EQ(import_geojson(map.dump()).error().message(),
            "/features/2/geometry/coordinates has no height; the program that has saved the map has dropped it; "
            "allowed: [longitude, latitude, metres above the place of take-off]");
}

RC_GTEST_PROP(geojson_property, exported_read_and_exported_again_it_is_the_same, ()) {
  const auto mission = mission_maker(*rc::gen::arbitrary<std::uint64_t>()).mission();
  const auto text = export_geojson(mission).text;
  const auto again = import_geojson(text);
  if (!again)
    RC_FAIL(again.error().message());
  RC_ASSERT(export_geojson(again->mission).text == text);
}

} // namespace geojson_import_test
} // namespace godwit::mission
