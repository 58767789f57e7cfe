#include "actors/executor/view.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace view_test {

constexpr std::int64_t now_ns = 1'000'000'000;

// At home, NORTH_M metres from there, as fast as that.
vehicle_view seen_at(double north_m, std::int16_t speed_cmps) {
  constexpr double units_a_metre = 1e7 / 111'195.0;
  vehicle_view result;
  result.take(io::mavlink::home_position{.latitude = 473'977'420, .longitude = 85'455'940}, 0);
  io::mavlink::global_position_int at;
  at.lat = 473'977'420 + static_cast<std::int32_t>(north_m * units_a_metre);
  at.lon = 85'455'940;
  at.vx = speed_cmps;
  result.take(at, now_ns);
  return result;
}

// ArduPilot's rover stays in RTL.
TEST(vehicle_view, stands_at_home_is_near_it_and_not_moving) {
  EXPECT_TRUE(seen_at(5, 10).stands_at_home(now_ns));
  EXPECT_FALSE(seen_at(5, 100).stands_at_home(now_ns)) << "it drives";
  EXPECT_FALSE(seen_at(30, 0).stands_at_home(now_ns)) << "it is elsewhere";
  EXPECT_FALSE(seen_at(5, 10).stands_at_home(now_ns + 2 * position_counts_ns)) << "where it is now is not known";
  EXPECT_FALSE(vehicle_view().stands_at_home(now_ns));
}

TEST(vehicle_view, what_it_has_warned_of_counts_from_then_on) {
  vehicle_view seen;
  const auto says = [&](const std::string& words, io::mavlink::mav_severity how, std::int64_t at_ns) {
    seen.take(flight::vehicle_message{io::mavlink::number(how), words}, at_ns);
  };
  says("Arm: Throttle too high", io::mavlink::mav_severity::critical, 5);
  says("Mission: 1 WP", io::mavlink::mav_severity::info, 6);
  EXPECT_EQ(seen.warned_since(5), "Arm: Throttle too high");
  EXPECT_EQ(seen.warned_since(6), "");
}

TEST(vehicle_view, plan_ids_are_kept_by_px4_and_by_who_has_told_one) {
  vehicle_view seen;
  seen.take(io::mavlink::heartbeat{.autopilot = io::mavlink::number(io::mavlink::mav_autopilot::generic)}, now_ns);
  seen.take(io::mavlink::mission_current{}, now_ns);
  EXPECT_FALSE(seen.keeps_plan_ids());
  seen.take(io::mavlink::mission_current{.mission_id = 7}, now_ns);
  EXPECT_TRUE(seen.keeps_plan_ids());
  vehicle_view px4;
  px4.take(io::mavlink::heartbeat{.autopilot = io::mavlink::number(io::mavlink::mav_autopilot::px4)}, now_ns);
  EXPECT_TRUE(px4.keeps_plan_ids());
}

TEST(vehicle_view, the_newer_of_heartbeat_and_current_mode_says_the_mode) {
  vehicle_view seen;
  seen.take(io::mavlink::current_mode{.custom_mode = 9});
  EXPECT_FALSE(seen.mode()) << "whose it is is not known yet";
  io::mavlink::heartbeat beat{.type = io::mavlink::number(io::mavlink::mav_type::quadrotor),
                              .autopilot = io::mavlink::number(io::mavlink::mav_autopilot::ardupilotmega),
                              .custom_mode = 3};
  seen.take(beat, now_ns);
  seen.take(io::mavlink::current_mode{.custom_mode = 9});
  EXPECT_TRUE(seen.is_in(flight::mode_kind::landing));
  seen.take(beat, now_ns);
  EXPECT_TRUE(seen.is_in(flight::mode_kind::mission));
}

// -- what it takes to be armed ----------------------------------------------------------------------

vehicle_view heard_of(io::mavlink::mav_autopilot autopilot) {
  vehicle_view result;
  result.take(io::mavlink::heartbeat{.autopilot = io::mavlink::number(autopilot)}, now_ns);
  return result;
}

TEST(vehicle_view, an_estimate_that_may_still_be_told_is_waited_for_and_not_for_ever) {
  using io::mavlink::mav_autopilot;
  for (const auto each : {mav_autopilot::ardupilotmega, mav_autopilot::px4}) {
    EXPECT_EQ(heard_of(each).estimate(now_ns + estimate_counts_ns), preflight::estimate::unknown);
    EXPECT_EQ(heard_of(each).estimate(now_ns + estimate_counts_ns + 1), preflight::estimate::not_told);
  }
  EXPECT_EQ(heard_of(mav_autopilot::generic).estimate(now_ns), preflight::estimate::not_told);
}

TEST(vehicle_view, an_estimate_counts_as_long_as_it_is_told) {
  auto seen = heard_of(io::mavlink::mav_autopilot::ardupilotmega);
  seen.take(io::mavlink::ekf_status_report{.flags = 0x00A7}, now_ns);
  EXPECT_EQ(seen.estimate(now_ns), preflight::estimate::not_ready);
  seen.take(io::mavlink::ekf_status_report{.flags = 0x033F}, now_ns);
  EXPECT_EQ(seen.estimate(now_ns + estimate_counts_ns), preflight::estimate::ready);
  EXPECT_EQ(seen.estimate(now_ns + estimate_counts_ns + 1), preflight::estimate::not_told);
}

TEST(vehicle_view, why_it_is_not_armed_is_what_it_said_last_and_of_late) {
  auto seen = heard_of(io::mavlink::mav_autopilot::ardupilotmega);
  const auto say = [&](const std::string& what, std::int64_t at_ns) {
    seen.take(flight::vehicle_message{.text = what}, at_ns);
  };
  say("PreArm: Gyros not calibrated", now_ns);
  say("PreArm: Need Position Estimate", now_ns);
  say("Mission: 3 WP", now_ns);
  EXPECT_EQ(seen.why_not_armed(now_ns + words_count_ns), "PreArm: Need Position Estimate");
  EXPECT_EQ(seen.why_not_armed(now_ns + words_count_ns + 1), "");
}

} // namespace view_test
} // namespace godwit::executor
