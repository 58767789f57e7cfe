#include "actors/movement_detector/settings.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace settings_test {

using namespace godwit::movement_detector;

settings sound() {
  settings result;
  result.width_px = 1280;
  result.height_px = 720;
  result.focal_px = 1000;
  return result;
}

std::string objection(void (*change)(settings&)) {
  auto changed = sound();
  change(changed);
  return objection_to(changed).value_or("");
}

TEST(camera_settings, what_is_missing_or_impossible_is_named) {
  EXPECT_FALSE(objection_to(sound()));
  EXPECT_EQ(objection([](settings& s) { s.width_px = 0; }).substr(0, 8), "width_px");
  EXPECT_EQ(objection([](settings& s) { s.height_px = 10'000; }).substr(0, 9), "height_px");
  EXPECT_EQ(objection([](settings& s) { s.focal_px = 0; }).substr(0, 8), "focal_px");
  EXPECT_EQ(objection([](settings& s) { s.focal_px = std::numeric_limits<double>::quiet_NaN(); }).substr(0, 8),
            "focal_px");
  EXPECT_EQ(objection([](settings& s) { s.attitude_sd_deg = 0; }).substr(0, 15), "attitude_sd_deg");
  EXPECT_EQ(objection([](settings& s) { s.is_on_gimbal = true; }), "");
  EXPECT_EQ(objection([](settings& s) {
              s.is_on_gimbal = true;
              s.mount_pitch_deg = 0;
            }).substr(0, 13),
            "mount_yaw_deg");
  EXPECT_EQ(objection([](settings& s) { s.class_group.clear(); }).substr(0, 11), "class_group");
  EXPECT_EQ(objection([](settings& s) { s.record_folder = "/tmp"; }).substr(0, 13), "record_max_mb");
}

} // namespace settings_test
