#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "actors/failsafe/takeover_detector.hpp"
#include "io/fields/json_value.hpp"

namespace takeover_detector_test {

using namespace godwit::failsafe;
using godwit::flight::end_is_told_within_ns;
using godwit::flight::mode_owner;
using godwit::flight::plan_end;
using godwit::io::mavlink::mav_autopilot;

constexpr instant start{100 * ns_per_s, 1'700'000'000 * ns_per_s};

instant later(std::int64_t ms) { return {start.monotonic_ns + ms * ns_per_ms, start.wall_ns + ms * ns_per_ms}; }

constexpr flight_now flies{.link_up = true, .in_flight = true, .may_act = true};
constexpr flight_now takes_off{.link_up = true, .in_flight = true, .may_act = true, .begins = true};
constexpr flight_now is_found{.link_up = true, .in_flight = true, .may_act = true, .begins = true, .is_found = true};
constexpr flight_now on_ground{.link_up = true};
constexpr flight_now has_ended{.link_up = true, .ends = true};

constexpr mode_owner copter{mav_autopilot::generic, vehicle_class::multirotor};
constexpr mode_owner px4{mav_autopilot::px4, vehicle_class::multirotor};

constexpr flight_mode mission{mode_kind::mission, 3};
constexpr flight_mode guided{mode_kind::guided, 4};
constexpr flight_mode loiters{mode_kind::hold, 5};
constexpr flight_mode brakes{mode_kind::hold, 17};
constexpr flight_mode returns{mode_kind::returning, 6};
constexpr flight_mode lands{mode_kind::landing, 9};
constexpr flight_mode manual{mode_kind::manual, 0};
constexpr flight_mode climbs{mode_kind::take_off, 18};
constexpr flight_mode unknown{mode_kind::unknown, 99};
constexpr flight_mode px4_take_off{mode_kind::take_off, 4U << 16U | 2U << 24U};
constexpr flight_mode px4_mission{mode_kind::mission, 4U << 16U | 4U << 24U};
constexpr flight_mode px4_hold{mode_kind::hold, 4U << 16U | 3U << 24U};

constexpr std::uint16_t last_item = 6;

plan_end ends_in_hold() { return {last_item, false, {brakes.custom_mode}}; }

// Each in a heartbeat of its own.
void see(takeover_detector& watch, const flight_now& flight, const flight_mode& mode, std::int64_t ms = 0,
         const mode_owner& whose = copter) {
  static std::int64_t heartbeats = 0;
  watch.evaluate(flight, {whose, mode, false, later(ms).monotonic_ns + ++heartbeats}, later(ms));
}

takeover_detector on_mission(const plan_end& end = {}) {
  takeover_detector watch({}, end, start);
  see(watch, on_ground, mission);
  see(watch, takes_off, mission);
  return watch;
}

// It tells its mode each second, and nothing else happens.
void hear(takeover_detector& watch, const flight_mode& mode, std::int64_t until_ms) {
  for (std::int64_t ms = 1'000; ms < until_ms; ms += 1'000)
    see(watch, flies, mode, ms);
}

bool takes_over(takeover_detector watch, const flight_mode& mode, std::int64_t ms = 0) {
  see(watch, flies, mode, ms);
  return watch.is_taken_over();
}

TEST(takeover_detector, a_mode_change_in_flight_that_no_command_of_ours_caused_is_a_pilot) {
  for (const auto& mode : {manual, loiters, brakes, returns, lands, unknown})
    EXPECT_TRUE(takes_over(on_mission(), mode)) << godwit::io::name_of(mode.kind);
  EXPECT_FALSE(takes_over(on_mission(), mission));
}

// Taken over all the same: it only changes whom it is called.
TEST(takeover_detector, a_change_that_an_ardupilot_calls_its_failsafes_is_not_a_pilots_and_leaves_it_alone_too) {
  constexpr mode_owner ardupilot{mav_autopilot::ardupilotmega, vehicle_class::multirotor};
  for (const std::string_view text : {"EKF Failsafe: changed to LAND Mode", "EKF Failsafe Cleared"}) {
    auto watch = on_mission();
    watch.on_text(ardupilot, text, start);
    see(watch, flies, lands, 0, ardupilot);
    EXPECT_TRUE(watch.is_taken_over());
    EXPECT_EQ(watch.is_autopilots(), text != "EKF Failsafe Cleared") << text;
  }
}

TEST(takeover_detector, a_change_between_two_modes_of_one_kind_is_a_change) {
  auto watch = on_mission();
  watch.expect({brakes.custom_mode}, 1'000, start);
  see(watch, flies, brakes);
  see(watch, flies, brakes, 2'000);
  EXPECT_FALSE(watch.is_taken_over());
  EXPECT_TRUE(takes_over(watch, loiters, 2'000));
}

TEST(takeover_detector, a_hold_by_loiter_where_brake_was_ordered_is_a_pilot) {
  auto watch = on_mission();
  watch.expect({brakes.custom_mode}, 5'000, start);
  EXPECT_FALSE(takes_over(watch, brakes));
  EXPECT_TRUE(takes_over(watch, loiters));
}

TEST(takeover_detector, a_mode_that_was_commanded_is_ours_for_a_while) {
  auto watch = on_mission();
  watch.expect({brakes.custom_mode}, 5'000, start);
  hear(watch, mission, 5'000);
  EXPECT_FALSE(takes_over(watch, brakes, 4'900));
  EXPECT_TRUE(takes_over(watch, brakes, 5'000)) << "the deadline";
}

TEST(takeover_detector, a_mode_that_was_commanded_is_ours_once) {
  auto watch = on_mission();
  watch.expect({brakes.custom_mode}, 5'000, start);
  see(watch, flies, brakes);
  watch.expect({mission.custom_mode}, 5'000, start);
  see(watch, flies, mission);
  EXPECT_FALSE(watch.is_taken_over());
  EXPECT_TRUE(takes_over(watch, brakes, 2'000));
}

TEST(takeover_detector, of_several_commands_the_later_one_leaves_the_earlier_behind_and_not_the_other_way_round) {
  auto watch = on_mission();
  watch.expect({brakes.custom_mode}, 5'000, start);
  watch.expect({guided.custom_mode}, 5'000, start);
  auto both = watch;
  see(both, flies, brakes);
  EXPECT_FALSE(takes_over(both, guided));
  see(watch, flies, guided);
  EXPECT_FALSE(watch.is_taken_over());
  EXPECT_TRUE(takes_over(watch, brakes)) << "it will not come any more";
}

TEST(takeover_detector, a_short_expectation_does_not_shorten_a_long_one) {
  auto watch = on_mission();
  watch.expect({returns.custom_mode}, 5'000, start);
  watch.expect({returns.custom_mode}, 1'000, start);
  see(watch, flies, mission, 2'000);
  EXPECT_FALSE(takes_over(watch, returns, 3'000));
}

TEST(takeover_detector, an_expectation_has_an_upper_bound) {
  auto watch = on_mission();
  watch.expect({brakes.custom_mode}, 86'400'000, start);
  hear(watch, mission, max_expectation_ms);
  EXPECT_FALSE(takes_over(watch, brakes, max_expectation_ms - 1));
  EXPECT_TRUE(takes_over(watch, brakes, max_expectation_ms));
}

TEST(takeover_detector, an_expectation_that_lasts_no_time_expects_nothing) {
  auto watch = on_mission();
  watch.expect({brakes.custom_mode}, 0, start);
  EXPECT_TRUE(takes_over(watch, brakes));
}

TEST(takeover_detector, a_return_does_not_land_by_itself) {
  auto watch = on_mission();
  watch.expect({returns.custom_mode}, 1'000, start);
  see(watch, flies, returns);
  EXPECT_TRUE(takes_over(watch, lands));
}

TEST(takeover_detector, a_take_off_of_px4_goes_on_by_itself) {
  takeover_detector climbing({}, {}, start);
  see(climbing, on_ground, px4_take_off, 0, px4);
  see(climbing, takes_off, px4_take_off, 0, px4);
  EXPECT_FALSE(climbing.is_taken_over());
  for (const auto& mode : {px4_mission, px4_hold}) {
    auto watch = climbing;
    see(watch, flies, mode, 0, px4);
    EXPECT_FALSE(watch.is_taken_over());
  }
  see(climbing, flies, {mode_kind::manual, 1U << 16U}, 0, px4);
  EXPECT_TRUE(climbing.is_taken_over());
}

TEST(takeover_detector, a_change_that_the_autopilot_makes_when_something_is_wrong_is_left_to_it) {
  auto watch = on_mission();
  watch.evaluate(flies, {copter, returns, true, later(1).monotonic_ns}, later(1));
  EXPECT_TRUE(watch.is_taken_over());
}

TEST(takeover_detector, a_pilot_who_puts_the_mode_back_still_has_the_vehicle) {
  auto watch = on_mission();
  see(watch, flies, manual);
  see(watch, flies, mission);
  EXPECT_TRUE(watch.is_taken_over());
}

TEST(takeover_detector, nothing_but_a_hand_back_gives_it_back_not_even_a_landing) {
  auto watch = on_mission();
  see(watch, flies, manual);
  watch.expect({mission.custom_mode}, 5'000, start);
  see(watch, flies, mission);
  EXPECT_TRUE(watch.is_taken_over());
  auto handed_back = watch;
  handed_back.hand_back();
  see(handed_back, flies, manual);
  EXPECT_FALSE(handed_back.is_taken_over());
  EXPECT_FALSE(takes_over(handed_back, manual)) << "the mode in which it was handed back is ours";
  see(watch, has_ended, manual);
  see(watch, takes_off, mission);
  EXPECT_TRUE(watch.is_taken_over());
}

TEST(takeover_detector, a_command_that_was_announced_along_with_the_hand_back_is_ours) {
  for (const bool hand_back_first : {false, true}) {
    auto watch = on_mission();
    see(watch, flies, manual);
    if (hand_back_first)
      watch.hand_back();
    watch.expect({mission.custom_mode}, 5'000, start);
    if (!hand_back_first)
      watch.hand_back();
    see(watch, flies, manual);
    EXPECT_FALSE(takes_over(watch, mission, 500));
    EXPECT_TRUE(takes_over(watch, returns, 500));
  }
}

TEST(takeover_detector, who_takes_over_after_a_hand_back_that_nobody_could_see_yet_has_the_vehicle) {
  auto watch = on_mission();
  see(watch, flies, manual);
  watch.hand_back();
  watch.take_over();
  EXPECT_TRUE(watch.is_taken_over());
  EXPECT_TRUE(takes_over(watch, manual));
}

TEST(takeover_detector, the_executors_word_is_enough) {
  auto watch = on_mission();
  watch.take_over();
  EXPECT_TRUE(takes_over(watch, mission));
}

TEST(takeover_detector, on_the_ground_modes_change_as_they_like) {
  takeover_detector watch({}, {}, start);
  for (const auto& mode : {manual, loiters, mission, unknown, mission})
    see(watch, on_ground, mode);
  see(watch, takes_off, mission);
  EXPECT_FALSE(watch.is_taken_over());
}

// -- the take-off ---------------------------------------------------------------------------------

TEST(takeover_detector, who_takes_off_in_any_mode_but_that_of_a_plan_or_of_a_take_off_is_a_pilot) {
  const auto taken_off_in = [](const flight_mode& mode) {
    takeover_detector watch({}, {}, start);
    see(watch, on_ground, mode);
    see(watch, takes_off, mode);
    return watch.is_taken_over();
  };
  for (const auto& mode : {mission, climbs})
    EXPECT_FALSE(taken_off_in(mode));
  for (const auto& mode : {manual, guided, loiters, returns, lands, unknown})
    EXPECT_TRUE(taken_off_in(mode)) << godwit::io::name_of(mode.kind);
}

// The landed state may be newer than the mode.
// As a real PX4 touched down in its return.
TEST(takeover_detector, what_bounces_in_the_mode_in_which_it_came_down_is_still_ours_and_in_another_a_pilots) {
  constexpr flight_now bounces{.link_up = true, .in_flight = true, .may_act = true, .begins = true, .is_bounce = true};
  for (const bool is_bounce : {true, false})
    for (const auto& mode : {returns, manual}) {
      auto watch = on_mission();
      watch.expect({returns.custom_mode}, 5'000, start);
      see(watch, flies, returns, 100);
      ASSERT_FALSE(watch.is_taken_over());
      see(watch, has_ended, returns, 200);
      for (std::int64_t ms = 300; ms < 3'000; ms += 1'000) // a newer heartbeat is waited for
        see(watch, ms == 300 ? (is_bounce ? bounces : takes_off) : flies, mode, ms);
      EXPECT_EQ(watch.is_taken_over(), !is_bounce || mode == manual) << is_bounce << godwit::io::name_of(mode.kind);
    }
}

TEST(takeover_detector, whose_a_take_off_is_a_heartbeat_says_that_came_after_it) {
  takeover_detector known({}, {}, start);
  see(known, on_ground, guided);
  takeover_detector started_again(known.memory(), {}, start);
  for (const auto& before : {known, started_again}) {
    auto watch = before;
    const seen_mode older{copter, guided, false, start.monotonic_ns};
    watch.evaluate(takes_off, older, later(100));
    watch.evaluate(flies, older, later(900));
    EXPECT_TRUE(watch.is_unclear());
    EXPECT_FALSE(watch.is_taken_over());
    auto starts = watch;
    see(starts, flies, mission, 1'000);
    EXPECT_FALSE(starts.is_unclear());
    EXPECT_FALSE(starts.is_taken_over());
    see(watch, flies, guided, 1'000);
    EXPECT_FALSE(watch.is_unclear());
    EXPECT_TRUE(watch.is_taken_over());
  }
}

// A person arms a vehicle that is held, the failsafe holds it for its battery, and the person starts the mission.
TEST(takeover_detector, a_mission_that_begins_while_the_failsafe_acts_is_a_persons_unless_it_was_commanded) {
  for (const bool is_commanded : {false, true}) {
    takeover_detector watch({}, {}, start);
    see(watch, on_ground, brakes);
    watch.evaluate(takes_off, {copter, brakes, false, later(-900).monotonic_ns}, later(0));
    EXPECT_TRUE(watch.is_unclear());
    watch.forget_the_plan();
    EXPECT_TRUE(watch.is_unclear());
    if (is_commanded)
      watch.expect({mission.custom_mode}, 5'000, later(50));
    see(watch, flies, mission, 100);
    EXPECT_EQ(watch.is_taken_over(), !is_commanded);
  }
}

TEST(takeover_detector, a_take_off_of_which_the_executor_says_that_it_is_a_pilots_is_not_unclear) {
  takeover_detector watch({}, {}, start);
  watch.evaluate(takes_off, {copter, manual, false, start.monotonic_ns}, later(100));
  watch.take_over();
  watch.evaluate(flies, {copter, manual, false, start.monotonic_ns}, later(200));
  EXPECT_TRUE(watch.is_taken_over());
  EXPECT_FALSE(watch.is_unclear());
}

TEST(takeover_detector, a_take_off_that_was_commanded_is_ours_in_any_mode) {
  takeover_detector watch({}, {}, start);
  watch.expect({guided.custom_mode}, 5'000, start);
  see(watch, on_ground, guided);
  see(watch, takes_off, guided);
  EXPECT_FALSE(watch.is_taken_over());
}

TEST(takeover_detector, a_command_that_was_announced_before_the_take_off_was_seen_is_ours) {
  takeover_detector watch({}, {}, start);
  watch.expect({loiters.custom_mode, mission.custom_mode}, 5'000, start); // it stands, and starts
  see(watch, on_ground, mission);
  watch.expect({brakes.custom_mode}, 5'000, start);
  see(watch, takes_off, mission, 100);
  EXPECT_FALSE(takes_over(watch, brakes, 500));
  EXPECT_TRUE(takes_over(watch, loiters, 500)) << "that was before the start";
}

TEST(takeover_detector, what_was_expected_in_one_flight_is_not_in_the_next) {
  auto watch = on_mission();
  watch.expect({returns.custom_mode}, 60'000, start);
  see(watch, has_ended, mission);
  see(watch, takes_off, mission);
  EXPECT_TRUE(takes_over(watch, returns));
}

// -- the end of the plan ---------------------------------------------------------------------------

TEST(takeover_detector, on_the_way_to_the_last_item_a_hold_is_a_pilots) {
  auto watch = on_mission(ends_in_hold());
  watch.on_place(last_item, false, start);
  see(watch, flies, brakes);
  EXPECT_TRUE(watch.is_unclear()) << "the word that the plan is done may be on its way";
  EXPECT_FALSE(watch.is_taken_over());
  watch.on_place(last_item, false, later(1'000));
  see(watch, flies, brakes, 1'000);
  EXPECT_TRUE(watch.is_taken_over());
  EXPECT_FALSE(watch.is_unclear());
}

TEST(takeover_detector, at_its_end_the_mode_into_which_the_plan_leads_is_ours_and_no_other) {
  auto watch = on_mission(ends_in_hold());
  watch.on_place(last_item, true, start);
  EXPECT_TRUE(takes_over(watch, loiters));
  EXPECT_TRUE(takes_over(watch, returns));
  see(watch, flies, brakes);
  EXPECT_FALSE(watch.is_taken_over());
  EXPECT_FALSE(watch.is_unclear());
  EXPECT_TRUE(takes_over(watch, manual, 5'000));
}

TEST(takeover_detector, until_the_end_of_the_plan_is_told_it_is_unclear_and_without_that_it_is_a_pilot) {
  auto watch = on_mission(ends_in_hold());
  see(watch, flies, brakes);
  EXPECT_TRUE(watch.is_unclear());
  auto told = watch;
  told.on_place(last_item, true, later(1'000));
  see(told, flies, brakes, 1'000);
  EXPECT_FALSE(told.is_unclear());
  EXPECT_FALSE(told.is_taken_over());
  constexpr auto within_ms = end_is_told_within_ns / ns_per_ms;
  see(watch, flies, brakes, within_ms - 1);
  EXPECT_TRUE(watch.is_unclear());
  see(watch, flies, brakes, within_ms);
  EXPECT_FALSE(watch.is_unclear());
  EXPECT_TRUE(watch.is_taken_over());
}

TEST(takeover_detector, a_plan_that_returns_does_so_as_its_return_begins) {
  auto watch = on_mission({last_item, true, {returns.custom_mode}});
  watch.on_place(last_item - 1, false, start);
  auto early = watch;
  see(early, flies, returns);
  early.on_place(last_item - 1, false, later(1'000));
  EXPECT_TRUE(takes_over(early, returns, 1'000));
  watch.on_place(last_item, false, start);
  EXPECT_FALSE(takes_over(watch, returns));
}

TEST(takeover_detector, when_a_failsafe_acts_the_plan_leads_nowhere_any_more_and_commands_are_still_on_their_way) {
  auto watch = on_mission(ends_in_hold());
  watch.on_place(last_item, true, start);
  watch.expect({guided.custom_mode}, 5'000, start);
  watch.forget_the_plan();
  EXPECT_TRUE(takes_over(watch, brakes));
  EXPECT_FALSE(takes_over(watch, guided));
}

TEST(takeover_detector, what_a_failsafe_made_of_the_plan_is_over_with_the_flight) {
  auto watch = on_mission(ends_in_hold());
  watch.forget_the_plan();
  see(watch, has_ended, mission);
  see(watch, takes_off, mission);
  watch.on_place(last_item, true, start);
  EXPECT_FALSE(takes_over(watch, brakes));
}

TEST(takeover_detector, what_was_said_of_the_plan_before_ends_no_plan) {
  auto watch = on_mission(ends_in_hold());
  watch.on_place(last_item, true, start);
  watch.set_plan_end(ends_in_hold());
  see(watch, flies, brakes);
  EXPECT_TRUE(watch.is_unclear());
}

// -- a restart ------------------------------------------------------------------------------------

takeover_detector restored(const takeover_detector& watch, instant now, const plan_end& end = {}) {
  return {watch.memory(), end, now};
}

TEST(takeover_detector, after_a_restart_a_mode_that_others_changed_is_a_pilots) {
  const auto again = restored(on_mission(), later(1'000));
  EXPECT_FALSE(takes_over(again, mission));
  for (const auto& mode : {returns, lands, manual, loiters, brakes})
    EXPECT_TRUE(takes_over(again, mode));
}

TEST(takeover_detector, after_a_restart_a_takeover_still_stands) {
  auto watch = on_mission();
  see(watch, flies, manual);
  EXPECT_TRUE(takes_over(restored(watch, later(1'000)), mission));
}

TEST(takeover_detector, after_a_restart_the_exact_modes_that_were_expected_still_are_until_their_deadline) {
  auto watch = on_mission();
  watch.expect({brakes.custom_mode, returns.custom_mode}, 10'000, start);
  const instant rebooted{1, later(5'000).wall_ns}; // the monotonic clock began anew
  const auto at = [&](std::int64_t ms) { return instant{1 + ms * ns_per_ms, rebooted.wall_ns + ms * ns_per_ms}; };
  const auto is_pilots = [&](const flight_mode& mode, std::int64_t ms) {
    auto again = restored(watch, rebooted);
    for (std::int64_t heard_ms = 1'000; heard_ms < ms; heard_ms += 1'000)
      again.evaluate(flies, {copter, mission, false, at(heard_ms).monotonic_ns}, at(heard_ms));
    again.evaluate(flies, {copter, mode, false, at(ms).monotonic_ns}, at(ms));
    return again.is_taken_over();
  };
  EXPECT_FALSE(is_pilots(brakes, 4'900));
  EXPECT_FALSE(is_pilots(returns, 4'900));
  EXPECT_TRUE(is_pilots(loiters, 0)) << "of the same kind, and not the same";
  EXPECT_TRUE(is_pilots(brakes, 5'000));
  EXPECT_TRUE(takes_over(restored(watch, later(10'000)), brakes, 10'000));
}

TEST(takeover_detector, after_a_restart_with_a_clock_that_was_set_back_an_expectation_is_still_bounded) {
  auto watch = on_mission();
  watch.expect({brakes.custom_mode}, 10'000, start);
  const instant set_back{start.monotonic_ns, start.wall_ns - 3'600 * ns_per_s};
  auto again = restored(watch, set_back);
  hear(again, mission, max_expectation_ms);
  EXPECT_TRUE(takes_over(again, brakes, max_expectation_ms));
}

TEST(takeover_detector, after_a_restart_the_plan_still_ends_where_it_ends) {
  auto watch = on_mission(ends_in_hold());
  see(watch, flies, brakes);
  ASSERT_TRUE(watch.is_unclear());
  auto again = restored(watch, later(500), ends_in_hold());
  see(again, flies, brakes, 500);
  EXPECT_TRUE(again.is_unclear());
  again.on_place(last_item, true, later(1'000));
  EXPECT_FALSE(takes_over(again, brakes, 1'000));
}

TEST(takeover_detector, a_record_of_an_earlier_version_is_read_and_what_it_expected_by_kind_counts_no_more) {
  const auto written = nlohmann::json::parse(R"({
    "ours": {"kind": "mission", "custom_mode": 3},
    "taken_over": false,
    "expected": [{"kind": "hold", "until_ns": 1700000060000000000}, {"kind": "returning", "until_ns": null},
                 {"kind": "landing"}]})");
  pilot_memory memory;
  const auto read = godwit::io::read_json(written, memory);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(memory.ours, mission);
  const takeover_detector watch(memory, {}, start);
  EXPECT_FALSE(takes_over(watch, mission));
  for (const auto& mode : {brakes, loiters, returns, lands})
    EXPECT_TRUE(takes_over(watch, mode)) << godwit::io::name_of(mode.kind);
}

TEST(takeover_detector, found_in_the_air_without_a_record_only_a_mission_is_ours) {
  const auto found_in = [](const flight_mode& mode) {
    takeover_detector watch({}, {}, start);
    see(watch, is_found, mode);
    return watch.is_taken_over();
  };
  EXPECT_FALSE(found_in(mission));
  for (const auto& mode : {returns, lands, manual, loiters, unknown, climbs})
    EXPECT_TRUE(found_in(mode));
}

TEST(takeover_detector, handed_back_it_knows_the_end_of_the_plan_that_was_set_last) {
  auto watch = on_mission();
  watch.set_plan_end(ends_in_hold());
  watch.take_over();
  watch.hand_back();
  see(watch, flies, mission);
  watch.on_place(last_item, true, later(100));
  EXPECT_FALSE(takes_over(watch, brakes, 200));
}

} // namespace takeover_detector_test
