#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace autopilot_checks_test {

using namespace test;

using io::mavlink::mav_autopilot;

verdict with(own_checks own) {
  auto seen = good_facts();
  seen.vehicle.own = own;
  return check_autopilot_checks(seen, {}).how;
}

// SYS_STATUS: present, enabled, health.
own_checks told_by(mav_autopilot autopilot, std::uint32_t present, std::uint32_t enabled, std::uint32_t health) {
  return own_checks_of({.onboard_control_sensors_present = present,
                        .onboard_control_sensors_enabled = enabled,
                        .onboard_control_sensors_health = health},
                       autopilot);
}

TEST(autopilot_check, passes_when_they_pass) { EXPECT_EQ(with(own_checks::passing), verdict::pass); }

TEST(autopilot_check, fails_when_they_fail) { EXPECT_EQ(with(own_checks::failing), verdict::fail); }

TEST(autopilot_check, names_the_parameter_that_keeps_a_plane_on_the_ground_whose_plan_marks_its_landing) {
  plan_result plans = std::vector<plan::flight_plan>(1);
  io::mavlink::mission_item_int marks;
  marks.command = io::mavlink::number(io::mavlink::mav_cmd::do_land_start);
  plans->front().items.push_back(marks);
  auto seen = good_facts();
  seen.vehicle.own = own_checks::failing;
  seen.vehicle.autopilot = mav_autopilot::ardupilotmega;
  seen.vehicle.what = flight::vehicle_class::fixed_wing;
  seen.mission.plans = &plans;
  const auto sentence = [&](const std::string& words) {
    seen.vehicle.why_not_armed = words;
    return check_autopilot_checks(seen, {}).sentence;
  };
  EXPECT_TRUE(has(sentence("PreArm: DO_LAND_START set and RTL_AUTOLAND disabled"), "Set RTL_AUTOLAND to 3"));
  EXPECT_FALSE(has(sentence({}), "RTL_AUTOLAND")) << "it does not hold that plan yet";
  seen.mission.is_brought = true;
  EXPECT_TRUE(has(sentence({}), "Set RTL_AUTOLAND to 3")) << "its words may be lost";
  EXPECT_FALSE(has(sentence("PreArm: Compass not calibrated"), "RTL_AUTOLAND"));
  plans->front().items.clear();
  EXPECT_FALSE(has(sentence({}), "RTL_AUTOLAND"));
}

TEST(autopilot_check, fails_before_anything_was_heard_of_them) { EXPECT_EQ(with(own_checks::unknown), verdict::fail); }

TEST(autopilot_check, degrades_when_the_autopilot_does_not_say) {
  EXPECT_EQ(with(own_checks::not_told), verdict::degraded);
}

TEST(autopilot_check, is_skipped_while_the_vehicle_is_not_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(check_autopilot_checks(seen, {}).how, verdict::skipped);
}

// The numbers are from recordings of ArduPilot's rover 4.7 and PX4 1.17, before and after they were ready.
TEST(autopilot_check, ardupilot_has_the_bit_and_sets_its_health) {
  EXPECT_EQ(told_by(mav_autopilot::ardupilotmega, 0x1331'DC0F, 0x1201'800F, 0x0311'810F), own_checks::failing);
  EXPECT_EQ(told_by(mav_autopilot::ardupilotmega, 0x1331'DC2F, 0x1221'802F, 0x1311'812F), own_checks::passing);
}

// ARMING_CHECK 0: present, and neither enabled nor healthy, whatever the vehicle does.
TEST(autopilot_check, an_ardupilot_whose_checks_are_switched_off_says_nothing) {
  EXPECT_EQ(told_by(mav_autopilot::ardupilotmega, 0x1331'DC2F, 0x0221'802F, 0x0311'812F), own_checks::not_told);
}

TEST(autopilot_check, px4_has_the_bit_in_its_health_alone) {
  EXPECT_EQ(told_by(mav_autopilot::px4, 0x0200'402F, 0x0201'402F, 0x0320'C83F), own_checks::failing);
  EXPECT_EQ(told_by(mav_autopilot::px4, 0x0300'402F, 0x0301'402F, 0x1320'C83F), own_checks::passing);
}

TEST(autopilot_check, another_autopilot_without_the_bit_says_nothing) {
  EXPECT_EQ(told_by(mav_autopilot::generic, 0x0200'002F, 0x0200'002F, 0x0200'002F), own_checks::not_told);
}

} // namespace autopilot_checks_test
} // namespace godwit::executor::preflight
