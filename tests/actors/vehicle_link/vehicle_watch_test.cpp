#include <gtest/gtest.h>

#include "actors/vehicle_link/vehicle_watch.hpp"
#include "io/mavlink/enums.hpp"

namespace {

using namespace godwit::vehicle_link;
using namespace godwit::io::mavlink;

constexpr std::int64_t s = 1'000'000'000;

heartbeat of_autopilot(mav_autopilot which = mav_autopilot::px4) {
  return {.type = number(mav_type::quadrotor), .autopilot = number(which)};
}

TEST(vehicle_watch, the_first_autopilot_heard_is_the_vehicle_and_stays_it) {
  vehicle_watch watch({});
  EXPECT_EQ(watch.on_transport(true, {})->phase, connection_phase::silent);
  EXPECT_EQ(watch.on_heartbeat(of_autopilot(), 3, 1, 0)->phase, connection_phase::connected);
  EXPECT_FALSE(watch.on_heartbeat(of_autopilot(), 4, 1, 1 * s));
  EXPECT_EQ(watch.vehicle()->system, 3);
  EXPECT_EQ(watch.other_autopilots(), 1U);
}

TEST(vehicle_watch, only_the_configured_system_is_the_vehicle) {
  vehicle_watch watch({.system = 7});
  (void)watch.on_transport(true, {});
  EXPECT_FALSE(watch.on_heartbeat(of_autopilot(), 3, 1, 0));
  EXPECT_TRUE(watch.on_heartbeat(of_autopilot(), 7, 1, 0));
  EXPECT_TRUE(watch.is_vehicle(7, 1));
}

TEST(vehicle_watch, ground_stations_gimbals_and_companions_are_not_vehicles) {
  vehicle_watch watch({});
  (void)watch.on_transport(true, {});
  EXPECT_FALSE(
      watch.on_heartbeat({.type = number(mav_type::gcs), .autopilot = number(mav_autopilot::invalid)}, 255, 190, 0));
  EXPECT_FALSE(watch.on_heartbeat({.type = number(mav_type::gcs), .autopilot = number(mav_autopilot::px4)}, 255, 1, 0));
  EXPECT_FALSE(watch.on_heartbeat(of_autopilot(), 1, 154, 0));
  EXPECT_FALSE(watch.vehicle());
}

TEST(vehicle_watch, the_link_is_lost_after_five_seconds_without_a_heartbeat_and_comes_back_with_one) {
  vehicle_watch watch({});
  (void)watch.on_transport(true, {});
  (void)watch.on_heartbeat(of_autopilot(), 1, 1, 10 * s);
  EXPECT_EQ(watch.next_deadline_ns(), 15 * s);
  EXPECT_FALSE(watch.on_time(15 * s - 1));
  const auto lost = watch.on_time(15 * s);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->phase, connection_phase::lost);
  EXPECT_FALSE(lost->reason.empty());
  EXPECT_FALSE(watch.on_time(16 * s)) << "told once";
  EXPECT_EQ(watch.heartbeat_age_ms(16 * s), 6'000);
  EXPECT_EQ(watch.on_heartbeat(of_autopilot(), 1, 1, 17 * s)->phase, connection_phase::connected);
}

TEST(vehicle_watch, a_transport_that_goes_down_says_why_and_comes_back_silent) {
  vehicle_watch watch({});
  (void)watch.on_transport(true, {});
  (void)watch.on_heartbeat(of_autopilot(), 1, 1, 0);
  EXPECT_EQ(watch.on_transport(false, "the cable is out")->reason, "the cable is out");
  EXPECT_FALSE(watch.next_deadline_ns());
  EXPECT_EQ(watch.on_transport(true, {})->phase, connection_phase::silent);
}

TEST(vehicle_watch, a_clock_that_goes_back_is_a_restart) {
  vehicle_watch watch({});
  EXPECT_FALSE(watch.on_boot_time(500'000));
  const auto restarted = watch.on_boot_time(3'000);
  ASSERT_TRUE(restarted);
  EXPECT_EQ(restarted->boot_ms_before, 500'000U);
  EXPECT_EQ(restarted->boot_ms_now, 3'000U);
  EXPECT_FALSE(watch.on_boot_time(3'100)) << "told once";
  EXPECT_EQ(watch.restarts(), 1U);
}

TEST(vehicle_watch, a_frame_that_comes_late_is_no_restart) {
  vehicle_watch watch({});
  (void)watch.on_boot_time(500'000);
  EXPECT_FALSE(watch.on_boot_time(500'000 - boot_time_tolerance_ms));
  EXPECT_FALSE(watch.on_boot_time(500'000 - boot_time_tolerance_ms / 2)) << "measured against the newest time";
}

TEST(vehicle_watch, the_wrap_of_the_clock_after_49_days_is_no_restart) {
  vehicle_watch watch({});
  (void)watch.on_boot_time(0xFFFF'FF00U);
  EXPECT_FALSE(watch.on_boot_time(100));
  EXPECT_EQ(watch.restarts(), 0U);
}

} // namespace
