#include <gtest/gtest.h>

#include "actors/failsafe/link_ladder.hpp"

namespace link_ladder_test {

using namespace godwit::failsafe;

constexpr std::int64_t boot_s = 1'000; // the computer runs since then

instant at(std::int64_t ms) { return {boot_s * ns_per_s + ms * ns_per_ms, 1'700'000'000 * ns_per_s + ms * ns_per_ms}; }

link_ladder seen_at_0(const settings& configured = {}) {
  link_ladder ladder(configured, {}, at(0));
  ladder.on_report(true, 0, at(0));
  return ladder;
}

TEST(link_ladder, ok_below_5_s_degraded_from_5_s_lost_from_30_s) {
  auto ladder = seen_at_0();
  EXPECT_EQ(ladder.evaluate(at(4'999)), link_phase::ok);
  EXPECT_EQ(ladder.evaluate(at(5'000)), link_phase::degraded);
  EXPECT_EQ(ladder.evaluate(at(29'999)), link_phase::degraded);
  EXPECT_EQ(ladder.evaluate(at(30'000)), link_phase::lost);
}

TEST(link_ladder, while_an_object_is_followed_it_is_lost_30_s_later) {
  auto ladder = seen_at_0();
  ladder.on_following(true);
  EXPECT_EQ(ladder.evaluate(at(59'999)), link_phase::degraded);
  EXPECT_EQ(ladder.evaluate(at(60'000)), link_phase::lost);
}

TEST(link_ladder, when_the_following_ends_late_the_link_is_lost_at_once) {
  auto ladder = seen_at_0();
  ladder.on_following(true);
  EXPECT_EQ(ladder.evaluate(at(45'000)), link_phase::degraded);
  ladder.on_following(false);
  EXPECT_EQ(ladder.evaluate(at(45'000)), link_phase::lost);
}

TEST(link_ladder, a_station_that_is_heard_again_makes_it_ok) {
  auto ladder = seen_at_0();
  EXPECT_EQ(ladder.evaluate(at(31'000)), link_phase::lost);
  ladder.on_report(true, 200, at(31'100));
  EXPECT_EQ(ladder.evaluate(at(31'100)), link_phase::ok);
  EXPECT_EQ(ladder.evaluate(at(35'900)), link_phase::degraded) << "heard at 30.9 s";
}

TEST(link_ladder, who_has_control_is_there_in_place_of_a_silent_station) {
  auto ladder = seen_at_0();
  ladder.on_controller(at(20'000));
  EXPECT_EQ(ladder.evaluate(at(24'000)), link_phase::ok);
  EXPECT_EQ(ladder.evaluate(at(49'000)), link_phase::degraded);
  EXPECT_EQ(ladder.evaluate(at(50'000)), link_phase::lost);
  ladder.on_controller(at(51'000));
  EXPECT_EQ(ladder.evaluate(at(51'000)), link_phase::ok);
}

TEST(link_ladder, who_closes_the_page_has_not_called_the_vehicle_home) {
  link_ladder ladder({}, {}, at(0));
  ladder.on_controller(at(1'000));
  EXPECT_EQ(ladder.evaluate(at(1'000'000)), link_phase::never_seen);
}

TEST(link_ladder, once_seen_never_seen_is_never_lost) {
  link_ladder ladder({}, {}, at(0));
  ladder.on_report(false, -1, at(1'000));
  EXPECT_EQ(ladder.evaluate(at(3'600'000)), link_phase::never_seen);
}

TEST(link_ladder, required_never_seen_is_lost_after_30_s) {
  link_ladder ladder({.operator_link = operator_link_policy::required}, {}, at(0));
  EXPECT_EQ(ladder.evaluate(at(4'999)), link_phase::ok);
  EXPECT_EQ(ladder.evaluate(at(29'999)), link_phase::degraded);
  EXPECT_EQ(ladder.evaluate(at(30'000)), link_phase::lost);
}

TEST(link_ladder, off_is_never_lost_however_long_it_is_silent) {
  auto ladder = seen_at_0({.operator_link = operator_link_policy::off});
  EXPECT_EQ(ladder.evaluate(at(3'600'000)), link_phase::off);
}

TEST(link_ladder, silence_of_the_port_itself_counts_as_silence_of_the_station) {
  auto ladder = seen_at_0();
  for (int ms = 100; ms < 30'000; ms += 100)
    EXPECT_NE(ladder.evaluate(at(ms)), link_phase::lost);
  EXPECT_EQ(ladder.evaluate(at(30'000)), link_phase::lost);
}

TEST(link_ladder, a_port_that_was_restarted_and_has_heard_nobody_changes_nothing) {
  auto ladder = seen_at_0();
  ladder.on_report(false, -1, at(20'000));
  EXPECT_EQ(ladder.evaluate(at(29'999)), link_phase::degraded);
  EXPECT_EQ(ladder.evaluate(at(30'000)), link_phase::lost);
}

TEST(link_ladder, an_old_report_that_comes_late_does_not_turn_the_time_back) {
  auto ladder = seen_at_0();
  ladder.on_report(true, 100, at(10'000));
  ladder.on_report(true, 8'000, at(10'000));
  ladder.on_report(true, std::int64_t{1} << 62, at(10'000));
  EXPECT_EQ(ladder.evaluate(at(14'899)), link_phase::ok);
}

TEST(link_ladder, a_jump_of_the_wall_clock_does_not_make_it_lost) {
  auto ladder = seen_at_0();
  auto later = at(1'000);
  later.wall_ns += 3'600 * ns_per_s;
  EXPECT_EQ(ladder.evaluate(later), link_phase::ok);
}

TEST(link_ladder, what_it_remembers_changes_with_the_phase_only) {
  auto ladder = seen_at_0();
  const auto ok = ladder.memory();
  (void)ladder.evaluate(at(4'000));
  EXPECT_EQ(ladder.memory(), ok);
  (void)ladder.evaluate(at(6'000));
  const auto silent = ladder.memory();
  EXPECT_EQ(silent.silent_since_ns, at(0).wall_ns);
  (void)ladder.evaluate(at(29'000));
  EXPECT_EQ(ladder.memory(), silent);
}

TEST(link_ladder, after_a_restart_it_goes_on_counting) {
  auto ladder = seen_at_0();
  (void)ladder.evaluate(at(10'000));
  link_ladder restarted({}, ladder.memory(), at(12'000));
  EXPECT_EQ(restarted.evaluate(at(29'999)), link_phase::degraded);
  EXPECT_EQ(restarted.evaluate(at(30'000)), link_phase::lost);
}

TEST(link_ladder, a_restart_alone_does_not_make_it_lost) {
  auto ladder = seen_at_0();
  (void)ladder.evaluate(at(29'000));
  link_ladder restarted({}, ladder.memory(), at(300'000));
  EXPECT_EQ(restarted.evaluate(at(300'000)), link_phase::degraded);
  EXPECT_EQ(restarted.evaluate(at(304'999)), link_phase::degraded);
  EXPECT_EQ(restarted.evaluate(at(305'000)), link_phase::lost);
}

TEST(link_ladder, it_remembers_over_a_restart_that_a_station_was_seen) {
  auto ladder = seen_at_0();
  link_ladder restarted({}, ladder.memory(), at(1'000));
  EXPECT_EQ(restarted.evaluate(at(31'000)), link_phase::lost);
}

} // namespace link_ladder_test
