#include "actors/domain/mission/convert/kml_import.hpp"

#include <gtest/gtest.h>

#include <string>

#include "actors/domain/mission/convert/convert.hpp"

namespace godwit::mission {
namespace kml_import_test {

constexpr std::uint8_t above_sea = 0;
constexpr std::uint8_t above_terrain = 10;

std::string kml_of(const std::string& inside) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<kml xmlns=\"http://www.opengis.net/kml/2.2\" xmlns:gx=\"http://www.google.com/kml/ext/2.2\"><Document>\n" +
         inside + "</Document></kml>\n";
}

std::string path_of(const std::string& mode, const std::string& coordinates) {
  return "<Placemark><name>a way</name><LineString><tessellate>1</tessellate>" + mode + "<coordinates>" + coordinates +
         "</coordinates></LineString></Placemark>\n";
}

std::string sentence_of(const import_result& result) { return result ? "it was taken" : result.error().message(); }

TEST(kml_import, a_path_and_points_are_waypoints_in_the_order_of_the_file_with_their_altitude_mode) {
  const auto result = import_kml(kml_of(
      "<Folder>" + path_of("<altitudeMode>absolute</altitudeMode>", "\n8.5455,47.3977,520\n\t8.5465,47.3987,530.5 \n") +
      "</Folder><Placemark><MultiGeometry><Point><coordinates>+8.55,47.4,30</coordinates>"
      "<altitudeMode> relativeToGround </altitudeMode></Point></MultiGeometry></Placemark>"));
  ASSERT_TRUE(result.has_value()) << result.error().message();
  const auto& items = result->mission.items;
  ASSERT_EQ(items.size(), 3U);
  const auto& first = std::get<command_item>(items[0]);
  EXPECT_EQ(first.frame, above_sea);
  EXPECT_EQ(first.params[4], 47.3977);
  EXPECT_EQ(first.params[5], 8.5455);
  EXPECT_EQ(first.params[6], 520);
  EXPECT_EQ(std::get<command_item>(items[1]).params[6], 530.5);
  EXPECT_EQ(std::get<command_item>(items[2]).frame, above_terrain);
  EXPECT_EQ(std::get<command_item>(items[2]).params[6], 30);
}

TEST(kml_import, a_path_on_the_ground_gets_the_altitude_that_was_asked_for_and_is_refused_without_one) {
  const auto text = kml_of(path_of("", "8.5455,47.3977,0 8.5465,47.3987"));
  import_options options;
  options.altitude_m = 40;
  const auto result = import_kml(text, options);
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(result->mission.items[1], item(waypoint{"item-2", {47.3987, 8.5465, 40}, 0, 0, {}}));
  const auto refused = sentence_of(import_kml(text));
  EXPECT_NE(refused.find("line 3 (LineString) has no heights"), std::string::npos) << refused;
  EXPECT_NE(refused.find("--altitude"), std::string::npos) << refused;
}

TEST(kml_import, heights_of_the_file_count_for_more_than_the_altitude_that_was_asked_for) {
  import_options options;
  options.altitude_m = 40;
  const auto result =
      import_kml(kml_of(path_of("<altitudeMode>absolute</altitudeMode>", "8.5,47.3,520 8.6,47.4,530")), options);
  ASSERT_TRUE(result.has_value()) << result.error().message();
  EXPECT_EQ(std::get<command_item>(result->mission.items[0]).params[6], 520);
}

TEST(kml_import, what_is_no_place_to_fly_to_is_a_loss_and_what_is_only_to_look_at_is_none) {
  const auto path = path_of("<altitudeMode>absolute</altitudeMode>", "8.5,47.3,520 8.6,47.4,530");
  const auto view = "<LookAt><longitude>8</longitude><altitudeMode>absolute</altitudeMode></LookAt>"
                    "<GroundOverlay><LatLonBox><north>1</north></LatLonBox></GroundOverlay>"
                    "<PhotoOverlay><Point><coordinates>1,2,3</coordinates></Point></PhotoOverlay>";
  const auto whole = import_kml(kml_of(view + path));
  ASSERT_TRUE(whole.has_value()) << whole.error().message();
  EXPECT_EQ(whole->mission.items.size(), 2U);
  const auto with_area = kml_of("<Placemark><Polygon><outerBoundaryIs><LinearRing><coordinates>1,2,3 3,4,5 5,6,7"
                                "</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>\n"
                                "<Placemark><gx:Track><gx:coord>1 2 3</gx:coord></gx:Track></Placemark>" +
                                path);
  const auto refused = import_kml(with_area);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().losses.all.size(), 2U);
  EXPECT_NE(sentence_of(refused).find("line 3: Polygon; says no place to fly to"), std::string::npos)
      << sentence_of(refused);
  import_options partial;
  partial.allow_partial = true;
  EXPECT_EQ(import_kml(with_area, partial)->mission.items.size(), 2U);
}

TEST(kml_import, a_place_that_is_none_is_named_with_its_line) {
  for (const std::string wrong : {"8.5", "8.5;47.3", "8.5,", "nan,47.3,5", "8.5,47.3,5,6", "8.5,47.3x", ","}) {
    const auto sentence = sentence_of(import_kml(
        kml_of(path_of("<altitudeMode>absolute</altitudeMode>", "8.5,47.3,520\n" + wrong + "\n8.6,47.4,530"))));
    EXPECT_NE(sentence.find("line 4 \"" + wrong + "\" is no place; allowed: longitude,latitude"), std::string::npos)
        << sentence;
  }
  const auto off_earth =
      sentence_of(import_kml(kml_of(path_of("<altitudeMode>absolute</altitudeMode>", "8.5,47.3,520\n8.5,95,520\n"))));
  EXPECT_NE(off_earth.find("line 4 (item 1, NAV_WAYPOINT"), std::string::npos) << off_earth;
}

TEST(kml_import, what_is_no_kml_is_named_as_what_it_is) {
  EXPECT_NE(sentence_of(import_kml("<gpx></gpx>")).find("is no KML: it begins with <gpx>"), std::string::npos);
  EXPECT_NE(sentence_of(import_kml(kml_of("<Placemark>"))).find("is not XML: mismatched tag"), std::string::npos);
  EXPECT_NE(sentence_of(import_kml("")).find("is not XML"), std::string::npos);
  EXPECT_NE(sentence_of(import_kml("PK\x03\x04more")).find("KMZ"), std::string::npos);
  EXPECT_NE(sentence_of(import_kml(kml_of(""))).find("holds no path and no point"), std::string::npos);
}

TEST(kml_import, entities_that_grow_and_elements_without_end_are_refused) {
  const auto bomb = "<!DOCTYPE kml [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]>\n" + kml_of("&b;");
  EXPECT_NE(sentence_of(import_kml(bomb)).find("declares a document type"), std::string::npos);
  std::string deep;
  for (int i = 0; i < 100'000; ++i)
    deep += "<Folder>";
  EXPECT_NE(sentence_of(import_kml(kml_of(deep))).find("nested deeper than 64"), std::string::npos);
  std::string long_path;
  for (int i = 0; i <= 10'000; ++i)
    long_path += "8.5,47.3,520 ";
  const auto sentence = sentence_of(import_kml(kml_of(path_of("<altitudeMode>absolute</altitudeMode>", long_path))));
  EXPECT_NE(sentence.find("comes after 10000 places"), std::string::npos) << sentence;
}

TEST(kml_import, kml_is_read_by_its_ending_and_not_written) {
  EXPECT_EQ(format_of_name("Field.KML"), mission_format::kml);
  const auto text = kml_of(path_of("<altitudeMode>absolute</altitudeMode>", "8.5,47.3,520 8.6,47.4,530"));
  EXPECT_TRUE(convert(text, mission_format::kml, mission_format::plan).has_value());
  const auto refused = convert(text, mission_format::kml, mission_format::kml);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message().find("can not be written as KML"), std::string::npos);
}

} // namespace kml_import_test
} // namespace godwit::mission
