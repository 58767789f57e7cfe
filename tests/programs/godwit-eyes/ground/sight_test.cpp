#include "programs/godwit-eyes/ground/sight.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/eyes/pose_of_view.hpp"

namespace godwit::eyes {
namespace sight_test {

constexpr double one_degree_rad = std::numbers::pi / 180;

camera_pose pose_at_50_m() {
  camera_pose pose;
  pose.height_m = 50;
  return pose;
}

TEST(sight, a_pose_that_can_not_be_is_refused) {
  const camera_pose right = pose_at_50_m();
  EXPECT_EQ(flaw_of(right, 0), pose_flaw::none);
  auto wrong = right;
  wrong.attitude.w = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(flaw_of(wrong, 0), pose_flaw::not_a_pose);
  wrong = right;
  wrong.attitude.w = 0;
  EXPECT_EQ(flaw_of(wrong, 0), pose_flaw::not_a_pose);
  wrong = right;
  wrong.latitude_deg = 91;
  EXPECT_EQ(flaw_of(wrong, 0), pose_flaw::not_a_pose);
  EXPECT_EQ(flaw_of(right, 1'100'000'000), pose_flaw::not_a_pose);
}

TEST(sight, how_old_a_pose_may_be_depends_on_how_fast_the_camera_turns) {
  camera_pose pose = pose_at_50_m();
  pose.rate.z_rad_s = 100 * one_degree_rad;
  EXPECT_EQ(flaw_of(pose, 10'000'000), pose_flaw::none);
  EXPECT_EQ(flaw_of(pose, 20'000'000), pose_flaw::too_old);
  pose.rate.z_rad_s = 1 * one_degree_rad;
  EXPECT_EQ(flaw_of(pose, 20'000'000), pose_flaw::none);
}

TEST(sight, a_pose_is_carried_to_the_time_of_the_picture) {
  sim::camera::camera_view view;
  view.attitude = sim::camera::rotation_of(1, 0.4, 0);
  view.rate = {0.2, 0.1, -0.3};
  const auto later = sim::camera::turned(view.attitude, {0.02 * 0.2, 0.02 * 0.1, 0.02 * -0.3});
  const camera_parameters camera = camera_from_field_of_view(640, 360, 60);
  const sight carried(camera, test::pose_of(view, 0), 20'000'000, 640);
  EXPECT_NEAR(carried.attitude()(0, 0), later[0].x, 1e-9);
  EXPECT_NEAR(carried.attitude()(1, 2), later[1].z, 1e-9);
}

TEST(sight, the_homography_of_the_ground_takes_pixels_where_the_simulator_sees_them) {
  sim::camera::lens glass{.width = 640, .height = 360, .focal_px = 500, .readout_s = 0};
  sim::camera::camera_view a;
  a.position = {0, 0, -60};
  a.attitude = sim::camera::rotation_of(0.3, 0.5, 0.02);
  sim::camera::camera_view b;
  b.position = {0.4, -0.3, -60.1};
  b.attitude = sim::camera::rotation_of(0.33, 0.51, 0.01);
  const auto camera = test::parameters_of(glass);
  const auto way =
      ground_homography(sight(camera, test::pose_of(a, 0), 0, 640), sight(camera, test::pose_of(b, 0), 0, 640));
  const sim::camera::row_views from(glass, a);
  const sim::camera::row_views to(glass, b);
  for (const sim::camera::vector3 place : {sim::camera::vector3{20, 5, 0}, {40, 20, 0}, {30, -5, 0}}) {
    const auto p = from.project(place);
    const auto q = to.project(place);
    ASSERT_TRUE(p && q);
    const Eigen::Vector3d found = way * Eigen::Vector3d(p->x, p->y, 1);
    EXPECT_NEAR(found.x() / found.z(), q->x, 0.05);
    EXPECT_NEAR(found.y() / found.z(), q->y, 0.05);
  }
}

TEST(sight, distortion_is_taken_back) {
  camera_parameters camera = camera_from_field_of_view(640, 360, 70);
  camera.k1 = -0.2;
  camera.k2 = 0.05;
  ASSERT_FALSE(problem_of(camera));
  camera_pose pose = pose_at_50_m();
  const sight from(camera, pose, 0, 640);
  const double x = 0.4;
  const double y = -0.2;
  const double r2 = x * x + y * y;
  const double factor = 1 + camera.k1 * r2 + camera.k2 * r2 * r2;
  const auto ray =
      from.ray(camera.centre_x_px + camera.focal_px * x * factor, camera.centre_y_px + camera.focal_px * y * factor);
  EXPECT_NEAR(ray.x() / ray.z(), x, 1e-4);
  EXPECT_NEAR(ray.y() / ray.z(), y, 1e-4);
}

TEST(camera_parameters, what_can_not_be_is_named) {
  auto camera = camera_from_field_of_view(1280, 720, 60);
  EXPECT_FALSE(problem_of(camera));
  camera.focal_px = 0;
  ASSERT_TRUE(problem_of(camera));
  EXPECT_NE(problem_of(camera)->find("focal_px"), std::string::npos);
  camera = camera_from_field_of_view(1280, 720, 60);
  camera.centre_y_px = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(problem_of(camera));
  EXPECT_NE(problem_of(camera)->find("centre_y_px"), std::string::npos);
}

} // namespace sight_test
} // namespace godwit::eyes
