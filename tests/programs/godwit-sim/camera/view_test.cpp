#include "programs/godwit-sim/camera/view.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::sim::camera {
namespace view_test {

constexpr double radian = std::numbers::pi / 180;

lens plain_lens() { return {.width = 641, .height = 361, .focal_px = 500, .readout_s = 0}; }

TEST(camera_view, straight_down_with_the_upper_edge_to_the_north_has_east_on_the_right) {
  camera_view view;
  view.position = {0, 0, -100};
  view.attitude = rotation_of(0, 0, 0);
  const row_views views(plain_lens(), view);
  const auto north = views.project({10, 0, 0});
  const auto east = views.project({0, 10, 0});
  ASSERT_TRUE(north && east);
  EXPECT_NEAR(north->x, 320, 1e-9);
  EXPECT_NEAR(north->y, 180 - 50, 1e-9); // 10 m at 100 m and 500 px
  EXPECT_NEAR(east->x, 370, 1e-9);
  EXPECT_NEAR(east->y, 180, 1e-9);
}

TEST(camera_view, a_tilt_looks_towards_the_heading) {
  camera_view view;
  view.position = {0, 0, -100};
  view.attitude = rotation_of(90 * radian, 45 * radian, 0);
  const row_views views(plain_lens(), view);
  const auto ahead = views.project({0, 100, 0}); // 45 degrees down, to the east
  ASSERT_TRUE(ahead);
  EXPECT_NEAR(ahead->x, 320, 1e-6);
  EXPECT_NEAR(ahead->y, 180, 1e-6);
  EXPECT_FALSE(views.project({0, -200, 0})); // behind the camera
}

RC_GTEST_PROP(camera_view, the_ray_through_a_projected_point_leads_back_to_it, ()) {
  const auto heading = *rc::gen::inRange(0, 360) * radian;
  const auto tilt = *rc::gen::inRange(0, 60) * radian;
  const auto rate = *rc::gen::inRange(-40, 41) * radian;
  lens glass = plain_lens();
  glass.readout_s = 0.02;
  camera_view view;
  view.position = {3, -4, -80};
  view.velocity = {5, 2, -1};
  view.attitude = rotation_of(heading, tilt, 0.05);
  view.rate = {0.1, rate, -0.2};
  const row_views views(glass, view);
  const double x = *rc::gen::inRange(0, 641);
  const double y = *rc::gen::inRange(0, 361);
  const camera_view row = views.at_row(y);
  const vector3 ray = row_views::ray(glass, row, x, y);
  RC_PRE(ray.z > 0.1);
  const double along = -row.position.z / ray.z;
  const auto back = views.project({row.position.x + along * ray.x, row.position.y + along * ray.y, 0});
  RC_ASSERT(back);
  RC_ASSERT(std::abs(back->x - x) < 0.1 && std::abs(back->y - y) < 0.1);
}

RC_GTEST_PROP(camera_view, a_quaternion_gives_its_rotation_back, ()) {
  const auto angle = [] { return *rc::gen::inRange(-179, 180) * radian; };
  const rotation before = rotation_of(angle(), angle(), angle());
  const auto q = quaternion_of(before);
  const rotation after = rotation_of_quaternion(q[0], q[1], q[2], q[3]);
  for (std::size_t row = 0; row < 3; ++row) {
    RC_ASSERT(std::abs(before[row].x - after[row].x) < 1e-9);
    RC_ASSERT(std::abs(before[row].y - after[row].y) < 1e-9);
    RC_ASSERT(std::abs(before[row].z - after[row].z) < 1e-9);
  }
}

TEST(camera_view, a_turn_is_what_was_turned_by) {
  const rotation from = rotation_of(1, 0.5, 0.1);
  const vector3 by{0.02, -0.3, 0.1};
  const vector3 found = turn_between(from, turned(from, by));
  EXPECT_NEAR(found.x, by.x, 1e-9);
  EXPECT_NEAR(found.y, by.y, 1e-9);
  EXPECT_NEAR(found.z, by.z, 1e-9);
}

} // namespace view_test
} // namespace godwit::sim::camera
