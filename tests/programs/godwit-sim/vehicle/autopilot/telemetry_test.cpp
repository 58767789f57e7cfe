#include "programs/godwit-sim/vehicle/autopilot/telemetry.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/programs/godwit-sim/vehicle/vehicle_world.hpp"

namespace godwit::sim::test {
namespace telemetry_test {

// A PX4 that flies north.
class px4_under_way : public vehicle_world {
public:
  px4_under_way() : vehicle_world(personality::px4) {
    EXPECT_EQ(upload(flight_of(6, home(), personality::px4)), mav_mission_result::accepted);
    EXPECT_EQ(command(mav_cmd::mission_start), mav_result::accepted);
    EXPECT_TRUE(run_until([&] { return picture().mission_current == 3; }, 60 * s));
    run_for(1 * s);
  }
};

TEST(telemetry, tells_where_it_is_and_how_it_moves) {
  px4_under_way world;
  const auto where = world.picture().where;
  const auto told = *world.last<mavlink::global_position_int>();
  EXPECT_NEAR(told.lat, where.latitude_deg * 1e7, 20);
  EXPECT_NEAR(told.lon, where.longitude_deg * 1e7, 20);
  EXPECT_NEAR(told.alt, where.altitude_m * 1e3, 100);
  EXPECT_NEAR(told.relative_alt, 10'000, 500);
  EXPECT_GT(told.vx, 200) << "north";
  EXPECT_NEAR(told.vy, 0, 30);
  const auto satellites = *world.last<mavlink::gps_raw_int>();
  EXPECT_EQ(satellites.fix_type, 3);
  EXPECT_GE(satellites.satellites_visible, 6);
  EXPECT_NEAR(satellites.vel, told.vx, 50);
  EXPECT_NEAR(world.last<mavlink::vfr_hud>()->groundspeed, world.picture().ground_speed_mps, 0.5);
}

TEST(telemetry, gives_angles_between_minus_and_plus_pi) {
  px4_under_way world;
  for (const auto& each : world.each<mavlink::attitude>())
    EXPECT_LE(std::abs(each.yaw), 3.1416F);
}

TEST(telemetry, tells_whether_it_is_on_the_ground_in_the_air_or_landing) {
  px4_under_way world;
  ASSERT_TRUE(world.run_until([&] { return !world.picture().armed; }, 100 * s));
  world.run_for(1 * s);
  std::vector<int> course;
  for (const auto& each : world.each<mavlink::extended_sys_state>())
    if (course.empty() || course.back() != each.landed_state)
      course.push_back(each.landed_state);
  EXPECT_EQ(course, (std::vector<int>{1, 2, 4, 1})) << "on the ground, in the air, landing, on the ground";
}

TEST(telemetry, is_in_standby_until_it_is_active_and_critical_without_a_position) {
  vehicle_world world(personality::px4);
  world.run_for(2 * s);
  EXPECT_EQ(world.last<mavlink::heartbeat>()->system_status, mavlink::number(mavlink::mav_state::standby));
  px4_under_way flying;
  EXPECT_EQ(flying.last<mavlink::heartbeat>()->system_status, mavlink::number(mavlink::mav_state::active));
  flying.subject().lose_position(true, flying.now_ns());
  flying.run_for(1 * s);
  EXPECT_EQ(flying.last<mavlink::heartbeat>()->system_status, mavlink::number(mavlink::mav_state::critical));
}

TEST(telemetry, a_boot_clock_and_a_calendar_go_on) {
  vehicle_world world(personality::rover);
  world.run_for(10 * s);
  const auto told = world.each<mavlink::system_time>();
  ASSERT_GE(told.size(), 9U);
  EXPECT_EQ(told[8].time_boot_ms - told[7].time_boot_ms, 1'000U);
  EXPECT_EQ(told[8].time_unix_usec - told[7].time_unix_usec, 1'000'000U);
}

} // namespace telemetry_test
} // namespace godwit::sim::test
