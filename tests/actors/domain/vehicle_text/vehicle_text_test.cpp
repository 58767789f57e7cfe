#include "actors/domain/vehicle_text/vehicle_text.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace godwit::flight {
namespace vehicle_text_test {

io::mavlink::statustext saying(std::string_view what) {
  io::mavlink::statustext result;
  std::copy_n(what.begin(), std::min(what.size(), result.text.size()), result.text.begin());
  return result;
}

TEST(vehicle_text, ends_with_its_nul_or_fills_the_message) {
  EXPECT_EQ(text_of(saying("PreArm: Gyros not healthy")), "PreArm: Gyros not healthy");
  EXPECT_EQ(text_of(saying(std::string(50, 'x'))), std::string(50, 'x'));
  EXPECT_EQ(text_of({}), "");
}

TEST(vehicle_text, of_each_failsafe_of_an_ardupilot_is_known) {
  for (const auto* each :
       {"EKF Failsafe: changed to LAND Mode", "EKF Failsafe", "Radio Failsafe", "Radio Failsafe - Land",
        "Battery Failsafe", "Radio + Battery Failsafe", "GCS Failsafe", "GCS Failsafe On: switched to QLand",
        "RC Short Failsafe: switched to CIRCLE", "RC Long Failsafe On: RTL", "Deadreckon Failsafe"})
    EXPECT_TRUE(tells_failsafe(each)) << each;
}

TEST(vehicle_text, of_a_failsafe_that_is_over_or_changes_nothing_is_none) {
  for (const auto* each : {"EKF Failsafe Cleared", "GCS Failsafe Cleared", "RC Long Failsafe Cleared",
                           "Radio Failsafe - Continuing Auto Mode", "EKF variance: over thresholds", "Failsafe",
                           "Mode change to RTL: the GCS Failsafe", ""})
    EXPECT_FALSE(tells_failsafe(each)) << each;
}

TEST(vehicle_text, of_a_breach_of_an_ardupilots_own_fence_is_known) {
  for (const auto* each : {"Circle fence breached", "Max Alt fence breached", "Max Alt and Circle fences breached"})
    EXPECT_TRUE(tells_fence_breach(each)) << each;
  for (const auto* each : {"Fence breach cleared", "Circle fence active", "Circle fence in 4.2m", ""})
    EXPECT_FALSE(tells_fence_breach(each)) << each;
}

TEST(vehicle_text, says_why_it_can_not_be_armed) {
  EXPECT_TRUE(tells_why_not_armed("PreArm: Compass not calibrated"));
  EXPECT_TRUE(tells_why_not_armed("Preflight Fail: horizontal position unstable"));
  EXPECT_FALSE(tells_why_not_armed("Arming motors"));
}

} // namespace vehicle_text_test
} // namespace godwit::flight
