#include <gtest/gtest.h>

#include "actors/vehicle_link/vehicle_watch.hpp"
#include "io/mavlink/enums.hpp"
#include "tests/support/time_units.hpp"

namespace vehicle_watch_test {

using namespace godwit::vehicle_link;
using namespace godwit::io::mavlink;

using godwit::tests::s;

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
  EXPECT_EQ(watch.on_heartbeat(of_autopilot(), 3, 1, 0)->phase, connection_phase::silent) << "and it is named";
  EXPECT_EQ(watch.on_heartbeat(of_autopilot(), 7, 1, 0)->phase, connection_phase::connected);
  EXPECT_TRUE(watch.is_vehicle(7, 1, godwit::io::link::only_peer));
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

using godwit::tests::ms;
constexpr watch_settings open_line{.heartbeats_to_begin = 4};

TEST(vehicle_watch, where_anybody_can_speak_three_heartbeats_begin_nothing_and_the_fourth_does) {
  vehicle_watch watch(open_line);
  (void)watch.on_transport(true, {});
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(watch.on_heartbeat(of_autopilot(), 1, 1, i * s));
  EXPECT_FALSE(watch.vehicle());
  EXPECT_TRUE(watch.on_heartbeat(of_autopilot(), 1, 1, 3 * s));
}

TEST(vehicle_watch, while_the_vehicle_is_heard_nobody_else_is_it_from_another_peer) {
  vehicle_watch watch({});
  (void)watch.on_transport(true, {});
  (void)watch.on_heartbeat(of_autopilot(), 1, 1, 0, 7);
  for (int i = 0; i < 20; ++i)
    EXPECT_FALSE(watch.on_heartbeat(of_autopilot(), 1, 1, i * s / 5, 8));
  EXPECT_TRUE(watch.is_vehicle(1, 1, 7));
  EXPECT_FALSE(watch.is_vehicle(1, 1, 8));
  EXPECT_EQ(watch.on_time(5 * s)->phase, connection_phase::lost) << "the other one does not keep it alive";
}

TEST(vehicle_watch, after_a_silence_it_may_come_from_another_peer) {
  vehicle_watch watch(open_line);
  (void)watch.on_transport(true, {});
  for (int i = 0; i < 20; ++i)
    (void)watch.on_heartbeat(of_autopilot(), 1, 1, i * s, 7);
  (void)watch.on_time(30 * s);
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(watch.on_heartbeat(of_autopilot(), 1, 1, (31 + i) * s, 8));
  EXPECT_TRUE(watch.on_heartbeat(of_autopilot(), 1, 1, 34 * s, 8));
  EXPECT_TRUE(watch.is_vehicle(1, 1, 8));
}

TEST(vehicle_watch, it_comes_back_from_its_own_peer_with_one_heartbeat) {
  vehicle_watch watch(open_line);
  (void)watch.on_transport(true, {});
  for (int i = 0; i < 4; ++i)
    (void)watch.on_heartbeat(of_autopilot(), 1, 1, i * s, 7);
  (void)watch.on_time(30 * s);
  EXPECT_TRUE(watch.on_heartbeat(of_autopilot(), 1, 1, 31 * s, 7));
}

TEST(vehicle_watch, who_fell_silent_at_once_is_let_go_and_a_vehicle_that_was_flown_is_not) {
  for (const int heard : {4, 20}) {
    vehicle_watch watch({});
    (void)watch.on_transport(true, {});
    for (int i = 0; i < heard; ++i)
      (void)watch.on_heartbeat(of_autopilot(), 66, 1, i * s, 7);
    (void)watch.on_time(60 * s);
    (void)watch.on_heartbeat(of_autopilot(), 1, 1, 61 * s, 8);
    EXPECT_EQ(watch.is_vehicle(1, 1, 8), heard == 4) << heard;
  }
}

TEST(vehicle_watch, while_a_flight_is_open_its_vehicle_is_waited_for_and_the_other_one_is_named) {
  vehicle_watch watch({});
  EXPECT_FALSE(watch.keep(vehicle_name{1, 1})) << "the line is not open yet";
  EXPECT_NE(watch.on_transport(true, {})->reason.find("system 1"), std::string::npos);
  const auto news = watch.on_heartbeat(of_autopilot(), 2, 1, 0);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->phase, connection_phase::silent);
  for (const char* part : {"system 1", "system 2 is heard", "nothing is sent there", "end-flight"})
    EXPECT_NE(news->reason.find(part), std::string::npos) << part << ": " << news->reason;
  for (int i = 1; i < 60; ++i)
    EXPECT_FALSE(watch.on_heartbeat(of_autopilot(), 2, 1, i * s)) << "told once";
  EXPECT_FALSE(watch.vehicle());
  EXPECT_TRUE(watch.on_heartbeat(of_autopilot(), 1, 1, 60 * s));
  EXPECT_TRUE(watch.is_vehicle(1, 1, godwit::io::link::only_peer));
  EXPECT_EQ(watch.others(60 * s), std::vector{(vehicle_name{2, 1})});
  EXPECT_TRUE(watch.others(90 * s).empty()) << "it is not heard any more";
}

TEST(vehicle_watch, a_flight_that_is_over_lets_another_vehicle_be_taken) {
  vehicle_watch watch({});
  (void)watch.keep(vehicle_name{1, 1});
  (void)watch.on_transport(true, {});
  (void)watch.on_heartbeat(of_autopilot(), 2, 1, 0);
  EXPECT_EQ(watch.keep({})->phase, connection_phase::silent);
  EXPECT_EQ(watch.on_heartbeat(of_autopilot(), 2, 1, s)->phase, connection_phase::connected);
}

TEST(vehicle_watch, a_vehicle_that_is_kept_is_not_let_go_when_it_falls_silent_at_once) {
  vehicle_watch watch({});
  (void)watch.on_transport(true, {});
  (void)watch.on_heartbeat(of_autopilot(), 1, 1, 0, 7);
  (void)watch.keep(vehicle_name{1, 1});
  (void)watch.on_time(30 * s);
  (void)watch.on_heartbeat(of_autopilot(), 2, 1, 31 * s, 8);
  EXPECT_EQ(watch.vehicle()->system, 1);
  EXPECT_EQ(watch.phase(), connection_phase::lost);
  EXPECT_NE(watch.reason().find("system 2 is heard"), std::string::npos) << watch.reason();
}

TEST(vehicle_watch, a_clock_that_goes_back_and_rises_from_there_is_a_restart) {
  vehicle_watch watch({});
  EXPECT_FALSE(watch.on_boot_time(500'000, 0));
  EXPECT_FALSE(watch.on_boot_time(3'000, 100 * ms));
  EXPECT_FALSE(watch.on_boot_time(3'500, 600 * ms));
  const auto restarted = watch.on_boot_time(4'000, 1'100 * ms);
  ASSERT_TRUE(restarted);
  EXPECT_EQ(restarted->boot_ms_before, 500'000U);
  EXPECT_EQ(restarted->boot_ms_now, 4'000U);
  EXPECT_FALSE(watch.on_boot_time(4'100, 1'200 * ms)) << "told once";
  EXPECT_EQ(watch.restarts(), 1U);
}

TEST(vehicle_watch, frames_that_come_late_are_no_restart) {
  vehicle_watch watch({});
  (void)watch.on_boot_time(500'000, 0);
  EXPECT_FALSE(watch.on_boot_time(500'000 - boot_time_tolerance_ms, ms));
  EXPECT_FALSE(watch.on_boot_time(500'000 - boot_time_tolerance_ms / 2, 2 * ms)) << "measured against the newest time";
  for (std::int64_t i = 1; i <= 20; ++i) { // each second one of 1.5 s before
    EXPECT_FALSE(watch.on_boot_time(static_cast<std::uint32_t>(500'000 + i * 1'000), i * 1'000 * ms));
    EXPECT_FALSE(watch.on_boot_time(static_cast<std::uint32_t>(498'500 + i * 1'000), i * 1'000 * ms + ms));
  }
  EXPECT_EQ(watch.restarts(), 0U);
}

TEST(vehicle_watch, one_frame_that_comes_again_and_again_is_no_restart) {
  vehicle_watch watch({});
  (void)watch.on_boot_time(500'000, 0);
  for (std::int64_t i = 1; i <= 5; ++i)
    EXPECT_FALSE(watch.on_boot_time(3'000, i * 1'000 * ms));
}

TEST(vehicle_watch, the_wrap_of_the_clock_after_49_days_is_no_restart) {
  vehicle_watch watch({});
  (void)watch.on_boot_time(0xFFFF'FF00U, 0);
  for (std::uint32_t i = 1; i <= 5; ++i)
    EXPECT_FALSE(watch.on_boot_time(i * 1'000, i * 1'000 * ms));
  EXPECT_EQ(watch.restarts(), 0U);
}

TEST(vehicle_watch, frames_are_numbered_as_they_were_sent) {
  vehicle_watch watch({});
  const auto first = watch.number_of(254, 0);
  EXPECT_EQ(watch.number_of(1, ms), first + 3) << "two were lost";
  EXPECT_EQ(watch.number_of(255, 2 * ms), first + 1) << "late";
  EXPECT_EQ(watch.number_of(1, 3 * ms), first + 3) << "the same again";
  EXPECT_EQ(watch.number_of(2, 4 * ms), first + 4);
  EXPECT_GT(watch.number_of(1, 4 * ms + late_within_ns), first + 4) << "after a silence nothing is late";
}

} // namespace vehicle_watch_test
