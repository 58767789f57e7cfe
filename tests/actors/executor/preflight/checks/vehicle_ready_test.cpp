#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace vehicle_ready_test {

using namespace test;

using io::mavlink::mav_autopilot;

result with(estimate how, const std::string& says = {}) {
  auto seen = good_facts();
  seen.vehicle.estimate = how;
  seen.vehicle.why_not_armed = says;
  return check_vehicle_ready(seen, {});
}

TEST(vehicle_ready_check, passes_when_the_estimator_knows_where_it_is) {
  EXPECT_EQ(with(estimate::ready).how, verdict::pass);
}

TEST(vehicle_ready_check, fails_while_it_does_not_though_the_autopilots_own_checks_pass) {
  EXPECT_EQ(with(estimate::not_ready).how, verdict::fail);
}

TEST(vehicle_ready_check, a_plane_that_may_align_in_its_take_off_needs_an_acknowledgement) {
  auto seen = good_facts();
  seen.vehicle.estimate = estimate::not_ready;
  seen.vehicle.autopilot = mav_autopilot::ardupilotmega;
  seen.vehicle.what = flight::vehicle_class::fixed_wing;
  seen.vehicle.own = own_checks::passing;
  EXPECT_EQ(check_vehicle_ready(seen, {}).how, verdict::degraded);
  seen.vehicle.own = own_checks::failing;
  EXPECT_EQ(check_vehicle_ready(seen, {}).how, verdict::fail);
}

TEST(vehicle_ready_check, says_the_reason_in_the_vehicles_own_words) {
  const auto found = with(estimate::not_ready, "PreArm: Need Position Estimate");
  EXPECT_NE(found.sentence.find("PreArm: Need Position Estimate"), std::string::npos) << found.sentence;
}

TEST(vehicle_ready_check, fails_before_anything_was_heard_of_it) {
  EXPECT_EQ(with(estimate::unknown).how, verdict::fail);
}

TEST(vehicle_ready_check, is_skipped_for_a_vehicle_that_does_not_tell) {
  EXPECT_EQ(with(estimate::not_told).how, verdict::skipped);
}

TEST(vehicle_ready_check, is_skipped_while_the_vehicle_is_not_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(check_vehicle_ready(seen, {}).how, verdict::skipped);
}

// The numbers are from recordings of ArduPilot's rover 4.7 and PX4 1.17.
TEST(vehicle_ready_check, reads_the_flags_that_ardupilot_and_px4_send) {
  for (const auto before : {0x0400, 0x0000, 0x00A7})
    EXPECT_EQ(estimate_of(static_cast<std::uint16_t>(before)), estimate::not_ready) << before;
  for (const auto after : {0x033F, 0x037F, 0x03FF})
    EXPECT_EQ(estimate_of(static_cast<std::uint16_t>(after)), estimate::ready) << after;
}

TEST(vehicle_ready_check, waits_for_autopilots_that_have_a_message_for_it) {
  EXPECT_TRUE(tells_estimate(mav_autopilot::ardupilotmega));
  EXPECT_TRUE(tells_estimate(mav_autopilot::px4));
  EXPECT_FALSE(tells_estimate(mav_autopilot::generic));
}

} // namespace vehicle_ready_test
} // namespace godwit::executor::preflight
