#include "programs/godwit-sim/camera/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace godwit::sim::camera {
namespace scene_test {

TEST(camera_scene, a_mover_goes_its_speed_along_its_arc) {
  mover who;
  who.speed_m_s = 3;
  who.turn_rad_s = 0.2;
  for (double t = 0; t < 20; t += 0.5) {
    const auto a = place_of(who, t).at;
    const auto b = place_of(who, t + 0.01).at;
    EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), 0.03, 1e-6);
  }
  // Once around: back at the start.
  const auto round = place_of(who, 2 * std::numbers::pi / 0.2).at;
  EXPECT_NEAR(std::hypot(round.x, round.y), 0, 1e-6);
}

TEST(camera_scene, a_mover_that_pauses_says_speed_0_and_stays) {
  mover who;
  who.speed_m_s = 2;
  who.pause_every_s = 4;
  EXPECT_EQ(place_of(who, 2.9).speed_m_s, 2);
  EXPECT_EQ(place_of(who, 3.5).speed_m_s, 0);
  EXPECT_EQ(place_of(who, 3.2).at.x, place_of(who, 3.9).at.x);
  EXPECT_NEAR(place_of(who, 5).at.x, 8, 1e-9); // 3 s of the first four, and one more
}

TEST(camera_scene, what_stands_does_not_depend_on_where_one_looks_from) {
  auto settings = tier_b(4);
  settings.glints_a_cell = 0;
  const scene world(settings);
  const auto near = world.around({10, 10}, 50, 0);
  const auto far = world.around({10, 10}, 200, 0);
  ASSERT_FALSE(near.crowns.empty());
  for (const auto& each : near.crowns) {
    const auto same = [&](const crown_shape& other) {
      return other.centre.x == each.centre.x && other.centre.y == each.centre.y && other.pattern == each.pattern;
    };
    EXPECT_TRUE(std::ranges::any_of(far.crowns, same));
  }
}

TEST(camera_scene, tier_a_is_a_plane_in_even_light) {
  const scene world(tier_a(9));
  EXPECT_EQ(world.ground_z(12, 34), 0);
  EXPECT_EQ(world.sunlight(12, 34, 5), 1);
  EXPECT_TRUE(world.around({0, 0}, 100, 0).boxes.empty());
}

TEST(camera_scene, slopes_of_tier_b_are_such_that_the_search_for_the_ground_ends) {
  auto settings = tier_b(5);
  settings.relief_m = 2.2; // the end of the range
  const scene world(settings);
  double steepest = 0;
  for (int n = 0; n < 20000; ++n) {
    const double x = n * 0.37;
    const double y = n * 0.11;
    steepest = std::max(steepest, std::abs(world.ground_z(x + 0.5, y) - world.ground_z(x, y)) / 0.5);
  }
  EXPECT_GT(steepest, 0.02);
  EXPECT_LT(steepest, 0.35);
}

} // namespace scene_test
} // namespace godwit::sim::camera
