#include "programs/godwit-sim/camera/truth.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace godwit::sim::camera {
namespace truth_test {

TEST(camera_truth, a_line_is_json_and_ends) {
  truth what;
  what.time_s = 1.5;
  auto& person = what.movers.emplace_back();
  person.kind = "person";
  person.width_px = 5;
  const auto line = json_line(what);
  EXPECT_EQ(line.back(), '\n');
  const auto read = nlohmann::json::parse(line);
  EXPECT_EQ(read["time_s"], 1.5);
  EXPECT_EQ(read["movers"][0]["kind"], "person");
  EXPECT_EQ(read["movers"][0]["width_px"], 5);
}

TEST(camera_truth, a_place_north_of_the_origin_has_a_higher_latitude) {
  truth what;
  what.movers.emplace_back().north_m = 1000;
  place_on_earth(what, 47, 8);
  EXPECT_NEAR(what.movers[0].latitude_deg, 47 + 1000 / 111180.0, 1e-5);
  EXPECT_NEAR(what.movers[0].longitude_deg, 8, 1e-9);
}

} // namespace truth_test
} // namespace godwit::sim::camera
