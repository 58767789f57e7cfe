#include "programs/godwitd/sightings/sighting_line.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace sighting_line_test {

using namespace godwit;
using daemon::read_sighting;
using nlohmann::json;

json good() {
  return {{"id", "9a6c2b1e-0f4d-4b7a-8c3d-2e1f0a9b8c7d"},
          {"class_group", "vehicle"},
          {"latitude", 47.39895},
          {"longitude", 8.54722},
          {"confidence", 0.9},
          {"at", "1970-01-01T00:00:02Z"}};
}

TEST(sighting_line, a_line_is_a_sighting_of_the_mission) {
  auto line = good();
  line["altitude_m"] = 441.5;
  const auto seen = read_sighting(line.dump(), "7d1c");
  ASSERT_TRUE(seen) << seen.error();
  EXPECT_EQ(seen->id, line["id"]);
  EXPECT_EQ(seen->mission_id, "7d1c");
  EXPECT_EQ(seen->position.latitude_deg, 47.39895);
  EXPECT_EQ(seen->position.altitude_m, 441.5);
  EXPECT_EQ(seen->at_ns, 2'000'000'000);
}

TEST(sighting_line, all_but_the_altitude_has_to_be_there) {
  EXPECT_TRUE(read_sighting(good().dump(), "7d1c"));
  const auto whole = good();
  for (const auto& [key, value] : whole.items()) {
    auto line = whole;
    line.erase(key);
    const auto wrong = read_sighting(line.dump(), "7d1c");
    ASSERT_FALSE(wrong) << key;
    EXPECT_EQ(wrong.error(), "has no \"" + key + "\"");
  }
}

TEST(sighting_line, what_is_wrong_is_named) {
  const std::vector<std::pair<std::string, json>> mistakes{
      {"id", "seven"},     {"id", 7},           {"class_group", 1},     {"latitude", 91},     {"longitude", -181},
      {"confidence", 1.1}, {"at", "yesterday"}, {"altitude_m", "high"}, {"position", "here"}, {"latitude", nullptr}};
  for (const auto& [key, value] : mistakes) {
    auto line = good();
    line[key] = value;
    const auto wrong = read_sighting(line.dump(), "7d1c");
    ASSERT_FALSE(wrong) << key;
    EXPECT_NE(wrong.error().find(key), std::string::npos) << wrong.error();
  }
  EXPECT_FALSE(read_sighting("[]", "7d1c"));
  EXPECT_FALSE(read_sighting("{", "7d1c"));
}

} // namespace sighting_line_test
