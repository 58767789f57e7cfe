#include <gtest/gtest.h>

#include "actors/failsafe/pilot_watch.hpp"

namespace {

using namespace godwit::failsafe;

constexpr instant start{100 * ns_per_s, 1'700'000'000 * ns_per_s};

instant later(std::int64_t ms) { return {start.monotonic_ns + ms * ns_per_ms, start.wall_ns + ms * ns_per_ms}; }

constexpr flight_now flies{.link_up = true, .in_flight = true, .may_act = true};
constexpr flight_now takes_off{.link_up = true, .in_flight = true, .may_act = true, .begins = true};
constexpr flight_now is_found{.link_up = true, .in_flight = true, .may_act = true, .begins = true, .is_found = true};
constexpr flight_now on_ground{.link_up = true};
constexpr flight_now has_ended{.link_up = true, .ends = true};

constexpr flight_mode mission{mode_kind::mission, 3};
constexpr flight_mode holds{mode_kind::hold, 5};
constexpr flight_mode brakes{mode_kind::hold, 17};
constexpr flight_mode returns{mode_kind::returning, 6};
constexpr flight_mode lands{mode_kind::landing, 9};
constexpr flight_mode manual{mode_kind::manual, 0};
constexpr flight_mode unknown{mode_kind::unknown, 99};

pilot_watch on_mission() {
  pilot_watch watch({}, start);
  watch.evaluate(on_ground, mission, {}, start);
  watch.evaluate(takes_off, mission, {}, start);
  return watch;
}

bool takes_over(pilot_watch watch, const flight_mode& mode, std::optional<action> reacts = {}, std::int64_t ms = 0) {
  watch.evaluate(flies, mode, reacts, later(ms));
  return watch.is_taken_over();
}

TEST(pilot_watch, a_mode_change_in_flight_that_no_command_of_ours_caused_is_a_pilot) {
  for (const auto& mode : {manual, holds, returns, lands, unknown})
    EXPECT_TRUE(takes_over(on_mission(), mode)) << godwit::io::name_of(mode.kind);
  EXPECT_FALSE(takes_over(on_mission(), mission));
}

TEST(pilot_watch, a_change_between_two_modes_of_one_kind_is_a_change) {
  auto watch = on_mission();
  watch.expect(mode_kind::hold, 1'000, start);
  watch.evaluate(flies, holds, {}, start);
  watch.evaluate(flies, holds, {}, later(2'000));
  EXPECT_FALSE(watch.is_taken_over());
  EXPECT_TRUE(takes_over(watch, brakes, {}, 2'000));
}

TEST(pilot_watch, when_a_failsafe_acts_the_plan_leads_nowhere_any_more_and_commands_are_still_on_their_way) {
  auto watch = on_mission();
  watch.expect(mode_kind::hold, {}, start);
  watch.expect(mode_kind::guided, 5'000, start);
  watch.forget_the_plan();
  EXPECT_TRUE(takes_over(watch, holds));
  EXPECT_FALSE(takes_over(watch, {mode_kind::guided, 4}));
}

TEST(pilot_watch, a_mode_that_was_commanded_is_ours_for_a_while) {
  auto watch = on_mission();
  watch.expect(mode_kind::hold, 5'000, start);
  EXPECT_FALSE(takes_over(watch, holds, {}, 4'900));
  watch.evaluate(flies, mission, {}, later(5'000)); // the deadline
  EXPECT_TRUE(takes_over(watch, holds, {}, 5'100));
}

TEST(pilot_watch, a_mode_to_which_the_plan_leads_is_ours_to_the_end_of_the_flight) {
  auto watch = on_mission();
  watch.expect(mode_kind::returning, std::nullopt, start);
  EXPECT_FALSE(takes_over(watch, returns, {}, 3'600'000));
}

TEST(pilot_watch, a_short_expectation_does_not_shorten_a_long_one) {
  auto watch = on_mission();
  watch.expect(mode_kind::returning, std::nullopt, start);
  watch.expect(mode_kind::returning, 1'000, start);
  watch.evaluate(flies, mission, {}, later(2'000));
  EXPECT_FALSE(takes_over(watch, returns, {}, 3'000));
}

TEST(pilot_watch, an_expectation_has_an_upper_bound) {
  auto watch = on_mission();
  watch.expect(mode_kind::hold, 86'400'000, start);
  watch.evaluate(flies, mission, {}, later(max_expectation_ms));
  EXPECT_TRUE(takes_over(watch, holds, {}, max_expectation_ms));
}

TEST(pilot_watch, what_the_failsafe_itself_does_is_ours) {
  EXPECT_FALSE(takes_over(on_mission(), returns, action::return_home));
  EXPECT_FALSE(takes_over(on_mission(), lands, action::land));
  EXPECT_FALSE(takes_over(on_mission(), holds, action::hold));
  EXPECT_TRUE(takes_over(on_mission(), holds, action::return_home));
}

TEST(pilot_watch, a_return_lands_by_itself_and_a_take_off_goes_on_by_itself) {
  auto watch = on_mission();
  watch.expect(mode_kind::returning, 1'000, start);
  watch.evaluate(flies, returns, {}, start);
  EXPECT_FALSE(takes_over(watch, lands));
  pilot_watch climbing({}, start);
  climbing.evaluate(on_ground, {mode_kind::take_off, 2}, {}, start);
  climbing.evaluate(takes_off, {mode_kind::take_off, 2}, {}, start);
  EXPECT_FALSE(takes_over(climbing, mission));
  EXPECT_FALSE(takes_over(climbing, holds));
  EXPECT_TRUE(takes_over(climbing, manual));
}

TEST(pilot_watch, a_pilot_who_puts_the_mode_back_still_has_the_vehicle) {
  auto watch = on_mission();
  watch.evaluate(flies, manual, {}, start);
  watch.evaluate(flies, mission, {}, start);
  EXPECT_TRUE(watch.is_taken_over());
}

TEST(pilot_watch, nothing_but_a_hand_back_or_the_end_of_the_flight_gives_it_back) {
  auto watch = on_mission();
  watch.evaluate(flies, manual, {}, start);
  watch.expect(mode_kind::mission, std::nullopt, start);
  watch.evaluate(flies, mission, {}, start);
  EXPECT_TRUE(watch.is_taken_over());
  auto handed_back = watch;
  handed_back.hand_back();
  handed_back.evaluate(flies, manual, {}, start);
  EXPECT_FALSE(handed_back.is_taken_over());
  EXPECT_FALSE(takes_over(handed_back, manual)) << "the mode in which it was handed back is ours";
  watch.evaluate(has_ended, manual, {}, start);
  EXPECT_FALSE(watch.is_taken_over());
}

TEST(pilot_watch, the_executors_word_is_enough) {
  auto watch = on_mission();
  watch.take_over();
  EXPECT_TRUE(takes_over(watch, mission));
}

TEST(pilot_watch, on_the_ground_modes_change_as_they_like) {
  pilot_watch watch({}, start);
  for (const auto& mode : {manual, holds, mission, unknown, mission})
    watch.evaluate(on_ground, mode, {}, start);
  watch.evaluate(takes_off, mission, {}, start);
  EXPECT_FALSE(watch.is_taken_over());
}

TEST(pilot_watch, who_takes_off_by_hand_is_a_pilot) {
  pilot_watch watch({}, start);
  watch.evaluate(on_ground, manual, {}, start);
  watch.evaluate(takes_off, manual, {}, start);
  EXPECT_TRUE(watch.is_taken_over());
}

TEST(pilot_watch, what_was_expected_in_one_flight_is_not_in_the_next) {
  auto watch = on_mission();
  watch.expect(mode_kind::returning, std::nullopt, start);
  watch.evaluate(has_ended, mission, {}, start);
  watch.evaluate(takes_off, mission, {}, start);
  EXPECT_TRUE(takes_over(watch, returns));
}

TEST(pilot_watch, after_a_restart_a_mode_that_others_changed_is_a_pilots) {
  const auto memory = on_mission().memory();
  EXPECT_FALSE(takes_over(pilot_watch(memory, later(1'000)), mission));
  for (const auto& mode : {returns, lands, manual, holds})
    EXPECT_TRUE(takes_over(pilot_watch(memory, later(1'000)), mode));
}

TEST(pilot_watch, after_a_restart_a_takeover_still_stands) {
  auto watch = on_mission();
  watch.evaluate(flies, manual, {}, start);
  EXPECT_TRUE(takes_over(pilot_watch(watch.memory(), later(1'000)), mission));
}

TEST(pilot_watch, after_a_restart_what_was_expected_still_is) {
  auto watch = on_mission();
  watch.expect(mode_kind::hold, 10'000, start);
  watch.expect(mode_kind::landing, std::nullopt, start);
  const instant rebooted{1, later(5'000).wall_ns}; // the monotonic clock began anew
  pilot_watch restored(watch.memory(), rebooted);
  EXPECT_FALSE(takes_over(restored, holds));
  EXPECT_FALSE(takes_over(restored, lands));
  pilot_watch late(watch.memory(), later(10'000));
  EXPECT_TRUE(takes_over(late, holds));
}

TEST(pilot_watch, found_in_the_air_without_a_record_only_a_mission_is_ours) {
  const auto found_in = [](const flight_mode& mode) {
    pilot_watch watch({}, start);
    watch.evaluate(is_found, mode, {}, start);
    return watch.is_taken_over();
  };
  EXPECT_FALSE(found_in(mission));
  for (const auto& mode : {returns, lands, manual, holds, unknown})
    EXPECT_TRUE(found_in(mode));
}

} // namespace
