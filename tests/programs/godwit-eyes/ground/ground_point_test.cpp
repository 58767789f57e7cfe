#include "programs/godwit-eyes/ground/ground_point.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <GeographicLib/LocalCartesian.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/godwit-sim/camera/random.hpp"
#include "tests/support/eyes/pose_of_view.hpp"

namespace godwit::eyes {
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
