#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "actors/movement_detector/camera_attitude.hpp"

namespace camera_attitude_test {

using namespace godwit::movement_detector;

constexpr double quarter = std::numbers::pi / 2;

void expect_near(const std::array<double, 3>& is, const std::array<double, 3>& wanted) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(is.at(i), wanted.at(i), 1e-12) << i;
}

TEST(camera_attitude, a_level_camera_looks_ahead_with_its_right_to_the_right) {
  const auto mount = mount_of(0, 0, 0);
  expect_near(turned(mount, {0, 0, 1}), {1, 0, 0});
  expect_near(turned(mount, {1, 0, 0}), {0, 1, 0});
  expect_near(turned(mount, {0, 1, 0}), {0, 0, 1});
}

TEST(camera_attitude, one_that_is_turned_down_sees_the_ground_with_ahead_at_its_upper_edge) {
  const auto mount = mount_of(0, -quarter, 0);
  expect_near(turned(mount, {0, 0, 1}), {0, 0, 1});
  expect_near(turned(mount, {0, -1, 0}), {1, 0, 0});
  expect_near(turned(mount, {1, 0, 0}), {0, 1, 0});
}

TEST(camera_attitude, the_vehicle_turns_its_camera) {
  // The nose to the east, then the right wing down.
  const auto nadir = from_angles(0, 0, quarter) * mount_of(0, -quarter, 0);
  expect_near(turned(nadir, {0, -1, 0}), {0, 1, 0});
  const auto banked = from_angles(quarter, 0, 0) * mount_of(0, -quarter, 0);
  expect_near(turned(banked, {0, 0, 1}), {0, -1, 0});
}

TEST(camera_attitude, an_inverse_takes_it_back) {
  const auto any = from_angles(0.3, -0.4, 2.0);
  expect_near(turned(inverse(any), turned(any, {1, 2, 3})), {1, 2, 3});
}

} // namespace camera_attitude_test

namespace gimbal_attitude_test {

using namespace godwit::movement_detector;
using godwit::io::mavlink::gimbal_device_attitude_status;
namespace device_flags = godwit::io::mavlink::gimbal_device_flags;
namespace device_errors = godwit::io::mavlink::gimbal_device_error_flags;

constexpr double quarter = std::numbers::pi / 2;

// Turned to the right by YAW_RAD and down by a quarter of a right angle.
gimbal_device_attitude_status turned_right(double yaw_rad, std::uint16_t flags) {
  const auto lies = from_angles(0, -quarter / 4, yaw_rad);
  gimbal_device_attitude_status said;
  said.flags = flags;
  said.q = {static_cast<float>(lies.w), static_cast<float>(lies.x), static_cast<float>(lies.y),
            static_cast<float>(lies.z)};
  return said;
}

// The direction in which it looks, from north to the east.
double bearing_of(const rotation& lies) {
  const auto ahead = turned(lies, {1, 0, 0});
  return std::atan2(ahead[1], ahead[0]);
}

TEST(gimbal_attitude, yaw_is_against_north_or_against_the_heading_as_the_flags_say) {
  const double heading = 0.5;
  const auto bearing = [&](std::uint16_t flags) {
    return bearing_of(attitude_of(turned_right(0.2, flags), heading).value());
  };
  EXPECT_NEAR(bearing(device_flags::yaw_in_earth_frame), 0.2, 1e-6);
  EXPECT_NEAR(bearing(device_flags::yaw_in_vehicle_frame), 0.7, 1e-6);
  EXPECT_NEAR(bearing(device_flags::yaw_in_vehicle_frame | device_flags::yaw_lock), 0.7, 1e-6);
  EXPECT_NEAR(bearing(device_flags::yaw_lock), 0.2, 1e-6) << "the older rule";
  EXPECT_NEAR(bearing(0), 0.7, 1e-6);
}

TEST(gimbal_attitude, roll_and_pitch_are_against_the_horizon_in_both_frames) {
  for (const auto flags : {device_flags::yaw_in_earth_frame, device_flags::yaw_in_vehicle_frame}) {
    const auto ahead = turned(attitude_of(turned_right(0.2, flags), 0.5).value(), {1, 0, 0});
    EXPECT_NEAR(ahead[2], std::sin(quarter / 4), 1e-6);
  }
}

TEST(gimbal_attitude, without_a_heading_only_what_is_against_north_is_known) {
  EXPECT_FALSE(attitude_of(turned_right(0, device_flags::yaw_in_vehicle_frame), std::nullopt));
  EXPECT_TRUE(attitude_of(turned_right(0, device_flags::yaw_in_earth_frame), std::nullopt));
}

TEST(gimbal_attitude, what_it_does_not_trust_itself_and_what_is_no_rotation_are_not_believed) {
  const auto sound = turned_right(0, device_flags::yaw_in_earth_frame);
  ASSERT_TRUE(attitude_of(sound, 0));
  const auto is_believed = [&](auto change) {
    auto said = sound;
    change(said);
    return attitude_of(said, 0).has_value();
  };
  EXPECT_FALSE(is_believed([](auto& m) { m.q = {}; }));
  EXPECT_FALSE(is_believed([](auto& m) { m.q[0] = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_FALSE(is_believed([](auto& m) { m.failure_flags = device_errors::encoder_error; }));
  EXPECT_FALSE(is_believed([](auto& m) { m.failure_flags = device_errors::calibration_running; }));
  EXPECT_FALSE(is_believed([](auto& m) { m.flags |= device_flags::retract; }));
  EXPECT_FALSE(is_believed([](auto& m) { m.flags |= device_flags::yaw_in_vehicle_frame; })) << "both frames";
  EXPECT_TRUE(is_believed([](auto& m) { m.failure_flags = 1; })) << "it is at a limit";
}

TEST(gimbal_attitude, the_rate_is_that_of_the_turn_between_in_axes_of_what_turns) {
  const auto before = from_angles(0.3, -0.8, 2.0);
  const auto turn = from_angles(0, 0.02, 0);
  const auto rate = rate_between(before, before * turn, 0.1);
  EXPECT_NEAR(rate[0], 0, 1e-9);
  EXPECT_NEAR(rate[1], 0.2, 1e-9);
  EXPECT_NEAR(rate[2], 0, 1e-9);
  const auto still = rate_between(before, before, 0.1);
  EXPECT_NEAR(std::hypot(still[0], still[1], still[2]), 0, 1e-9);
}

} // namespace gimbal_attitude_test
