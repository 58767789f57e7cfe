#include "programs/godwitd/convert_command.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/programs/godwitd/scratch.hpp"

namespace convert_command_test {

using namespace godwit;
using namespace godwit::daemon;
using runtime::exit_code;
using test::scratch;

const std::string data = std::string(GODWIT_TEST_DATA) + "/missions/";

TEST(convert_command, our_form_survives_the_way_through_each_other_one) {
  const scratch folder;
  const auto first = folder.file("first.json");
  ASSERT_EQ(run_convert({data + "simple.plan", first}, false), exit_code::ok);
  for (const auto* other : {"way.plan", "way.waypoints", "way.geojson"}) {
    const auto there = folder.file(other);
    const auto back = folder.file("back.json");
    ASSERT_EQ(run_convert({first, there}, false), exit_code::ok) << other;
    ASSERT_EQ(run_convert({there, back}, false), exit_code::ok) << other;
    const auto before = load_mission_file(first, false);
    const auto after = load_mission_file(back, false);
    ASSERT_TRUE(before && after) << other;
    EXPECT_EQ(before->mission.items.size(), after->mission.items.size()) << other;
  }
}

TEST(convert_command, a_path_of_a_map_program_gets_the_altitude_of_the_command_line) {
  const scratch folder;
  const auto in = folder.file("path.kml");
  std::ofstream(in) << "<kml><Placemark><LineString><coordinates>8.5455,47.3977 8.5465,47.3987</coordinates>"
                       "</LineString></Placemark></kml>";
  const auto out = folder.file("path.json");
  convert_arguments given{in, out};
  EXPECT_EQ(run_convert(given, false), exit_code::failed);
  given.altitude_m = 40;
  ASSERT_EQ(run_convert(given, false), exit_code::ok);
  const auto written = load_mission_file(out, false);
  ASSERT_TRUE(written);
  EXPECT_EQ(std::get<mission::waypoint>(written->mission.items[1]).at.altitude_m, 40);
}

TEST(convert_command, what_can_not_be_carried_over_is_refused_and_nothing_is_written) {
  const scratch folder;
  const auto out = folder.file("out.json");
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_convert({data + "unknown_properties.plan", out}, false), exit_code::failed);
  const auto said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("--allow-partial"), std::string::npos) << said;
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_FALSE(std::filesystem::exists(out + ".new"));
}

TEST(convert_command, a_partial_conversion_is_written_and_says_what_is_missing) {
  const scratch folder;
  const auto out = folder.file("out.json");
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_convert({data + "unknown_properties.plan", out}, true), exit_code::ok);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("is without this"), std::string::npos);
  EXPECT_TRUE(load_mission_file(out, false));
}

TEST(convert_command, an_ending_without_a_format_is_usage) {
  const scratch folder;
  EXPECT_EQ(run_convert({data + "simple.plan", folder.file("out.gpx")}, false), exit_code::usage);
  EXPECT_EQ(run_convert({folder.file("in.gpx"), folder.file("out.json")}, false), exit_code::usage);
}

TEST(convert_command, a_file_that_is_not_there_or_no_mission_is_said_by_name) {
  const scratch folder;
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_convert({folder.file("none.plan"), folder.file("out.json")}, false), exit_code::failed);
  EXPECT_EQ(run_convert({folder.write("bad.json", "{"), folder.file("out.json")}, false), exit_code::failed);
  EXPECT_EQ(run_convert({data + "simple.plan", folder.file("no/folder/out.json")}, false), exit_code::failed);
  const auto said = testing::internal::GetCapturedStderr();
  for (const auto* each : {"none.plan", "bad.json", "no/folder/out.json"})
    EXPECT_NE(said.find(each), std::string::npos) << each;
}

} // namespace convert_command_test
