#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/LU>
#include <GeographicLib/LocalCartesian.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-eyes/ground/sight.hpp"
#include "programs/godwit-sim/camera/random.hpp"
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

namespace ground_point_test {

constexpr double radian = std::numbers::pi / 180;
constexpr double limit = 70 * radian;

sim::camera::camera_view view_from(double height_m, double heading_deg, double off_nadir_deg) {
  sim::camera::camera_view view;
  view.position = {12, -7, -height_m};
  view.attitude = sim::camera::rotation_of(heading_deg * radian, off_nadir_deg * radian, 0);
  return view;
}

camera_parameters camera() { return camera_from_field_of_view(1280, 720, 60); }

pixel_box box_at(double x, double y) { return {x - 9.5, y - 4.5, 20, 10}; }

// North and east of the origin.
Eigen::Vector2d local(const ground_place& place) {
  const GeographicLib::LocalCartesian frame(test::origin_latitude_deg, test::origin_longitude_deg);
  double east = 0;
  double north = 0;
  double up = 0;
  frame.Forward(place.latitude_deg, place.longitude_deg, 0, east, north, up);
  return {north, east};
}

TEST(ground_point, the_middle_of_a_picture_straight_down_is_below_the_camera) {
  const sight from(camera(), test::pose_of(view_from(100, 30, 0), 0), 0, 1280);
  const auto place = ground_point(from, box_at(639.5, 359.5), limit);
  ASSERT_TRUE(place);
  EXPECT_NEAR(local(*place).x(), 12, 1e-3);
  EXPECT_NEAR(local(*place).y(), -7, 1e-3);
  EXPECT_NEAR(place->size_m, 20 * 100 / camera().focal_px, 1e-6);
}

RC_GTEST_PROP(ground_point, is_where_the_simulator_has_the_pixel, ()) {
  const auto view = view_from(*rc::gen::inRange(10, 150), *rc::gen::inRange(0, 360), *rc::gen::inRange(0, 45));
  sim::camera::lens glass;
  glass.focal_px = camera().focal_px;
  const double x = *rc::gen::inRange(0, 1280);
  const double y = *rc::gen::inRange(0, 720);
  const auto ray = sim::camera::row_views::ray(glass, view, x, y);
  RC_PRE(ray.z > 0.4 * std::hypot(ray.x, ray.y));
  const sight from(camera(), test::pose_of(view, 0), 0, 1280);
  const auto place = ground_point(from, box_at(x, y), limit);
  RC_ASSERT(place);
  const double along = -view.position.z / ray.z;
  const double off = std::hypot(local(*place).x() - view.position.x - along * ray.x,
                                local(*place).y() - view.position.y - along * ray.y);
  RC_ASSERT(off < 0.05); // the Earth is round: 1 cm over 400 m
}

TEST(ground_point, at_100_m_and_45_degrees_an_error_of_1_degree_is_3_5_m) {
  const auto view = view_from(100, 200, 45);
  const sight right(camera(), test::pose_of(view, 0), 0, 1280);
  const sight wrong(camera(), test::pose_of(view, 0, {1 * radian, 0, 0}), 0, 1280);
  const auto a = ground_point(right, box_at(639.5, 359.5), limit);
  const auto b = ground_point(wrong, box_at(639.5, 359.5), limit);
  ASSERT_TRUE(a && b);
  const double off = (local(*a) - local(*b)).norm();
  EXPECT_NEAR(off, 3.49, 0.1); // h * d / cos^2
  EXPECT_LT(off, 3.6);
}

// Errors as the pose says of itself: 95 % of the points lie within two deviations, which for two dimensions is a
// squared distance of 5.99.
TEST(ground_point, lies_within_its_own_covariance_in_95_of_100) {
  sim::camera::random_source random(11);
  constexpr int count = 4000;
  constexpr double attitude_sd = 1 * radian;
  int inside = 0;
  for (int n = 0; n < count; ++n) {
    const auto view = view_from(100, random.between(0, 360), random.between(0, 45));
    const double x = random.between(100, 1180);
    const double y = random.between(200, 620);
    const sight right(camera(), test::pose_of(view, 0), 0, 1280);
    camera_pose told = test::pose_of(
        view, 0, {attitude_sd * random.gaussian(), attitude_sd * random.gaussian(), attitude_sd * random.gaussian()});
    told.attitude_sd_rad = attitude_sd;
    told.position_sd_m = 1.5;
    told.height_sd_m = 2;
    const Eigen::Vector2d shift(1.5 * random.gaussian(), 1.5 * random.gaussian());
    told.latitude_deg += shift.x() / 111180;
    told.longitude_deg += shift.y() / (111320 * std::cos(test::origin_latitude_deg * radian));
    told.height_m += 2 * random.gaussian();
    const auto real = ground_point(right, box_at(x, y), limit);
    const auto found = ground_point(sight(camera(), told, 0, 1280), box_at(x, y), limit);
    ASSERT_TRUE(real && found);
    Eigen::Matrix2d covariance;
    covariance << found->variance_north_m2, found->covariance_m2, found->covariance_m2, found->variance_east_m2;
    const Eigen::Vector2d off = local(*found) - local(*real);
    inside += off.dot(covariance.inverse() * off) < 5.99 ? 1 : 0;
  }
  EXPECT_GT(inside, 0.935 * count);
  EXPECT_LT(inside, 0.97 * count);
}

TEST(ground_point, beyond_the_limit_off_the_nadir_there_is_none) {
  const sight from(camera(), test::pose_of(view_from(100, 0, 60), 0), 0, 1280);
  EXPECT_TRUE(ground_point(from, box_at(639.5, 359.5), limit));
  EXPECT_FALSE(ground_point(from, box_at(639.5, 10), limit)); // 18 degrees higher
}

} // namespace ground_point_test

} // namespace godwit::eyes
