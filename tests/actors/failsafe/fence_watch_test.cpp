#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "actors/failsafe/events.hpp"
#include "actors/failsafe/fence_watch.hpp"
#include "tests/actors/failsafe/positions.hpp"

namespace fence_watch_test {

using namespace godwit::failsafe;
using namespace godwit::tests;
using godwit::mission::fence_kind;
using godwit::mission::geofence;

using failsafe_position = godwit::failsafe::position;

constexpr auto s = ns_per_s;

fence_watch watch_of(const std::vector<geofence>& fences) {
  fence_watch result;
  result.set(godwit::geofence::fence_set::build(fences).value());
  return result;
}

// Two positions of different vehicle time: there it is.
void stays(fence_watch& watch, failsafe_position there, std::int64_t now_ns) {
  there.boot_ms = static_cast<std::uint32_t>(now_ns / ns_per_ms);
  watch.on_position(there, now_ns);
  there.boot_ms += 1;
  watch.on_position(there, now_ns);
}

failsafe_position timed(failsafe_position there, std::int64_t now_ns) {
  there.boot_ms = static_cast<std::uint32_t>(now_ns / ns_per_ms) + 1;
  return there;
}

fence_watch within_100_m() { return watch_of({fence_of(fence_kind::inclusion, square(100))}); }

TEST(fence_watch, without_fences_there_is_nothing_to_judge_and_no_position_is_missed) {
  fence_watch watch;
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::no_fences);
  watch.on_position(position_at(0, 0), 0);
  EXPECT_EQ(watch.evaluate(10 * s, false).finding, fence_finding::no_fences);
}

TEST(fence_watch, a_position_older_than_1_s_gives_no_verdict) {
  auto watch = within_100_m();
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::no_verdict) << "never any";
  watch.on_position(position_at(0, 0), 0);
  EXPECT_EQ(watch.evaluate(1 * s, false).finding, fence_finding::inside);
  EXPECT_EQ(watch.evaluate(1 * s + 1, false).finding, fence_finding::no_verdict);
}

TEST(fence_watch, an_old_position_outside_is_no_breach_either) {
  auto watch = within_100_m();
  watch.on_position(position_at(200, 0), 0);
  EXPECT_EQ(watch.evaluate(s + 1, false).finding, fence_finding::no_verdict);
}

TEST(fence_watch, one_position_outside_is_no_breach_and_the_next_of_another_time_makes_it_one) {
  auto watch = within_100_m();
  watch.on_position(timed(position_at(0, 0), 0), 0);
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::inside);
  watch.on_position(timed(position_at(200, 0), s / 4), s / 4);
  EXPECT_EQ(watch.evaluate(s / 4, false).finding, fence_finding::inside);
  watch.on_position(timed(position_at(200, 0), s / 4), s / 3);
  EXPECT_EQ(watch.evaluate(s / 3, false).finding, fence_finding::inside) << "the same once more";
  watch.on_position(timed(position_at(201, 0), s / 2), s / 2);
  EXPECT_EQ(watch.evaluate(s / 2, false).finding, fence_finding::breached);
}

TEST(fence_watch, a_jump_of_one_position_over_a_fence_and_back_is_no_breach) {
  auto watch = watch_of({fence_of(fence_kind::exclusion, square(2))});
  for (int i = 0; i < 40; ++i) {
    const auto now = i * s / 4;
    watch.on_position(timed(position_at(i % 2 == 0 ? -5 : 5, 0), now), now);
    EXPECT_EQ(watch.evaluate(now, false).finding, fence_finding::inside) << i;
  }
}

TEST(fence_watch, two_positions_outside_that_are_more_than_two_seconds_apart_are_two_jumps) {
  auto watch = within_100_m();
  watch.on_position(timed(position_at(200, 0), 0), 0);
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::inside);
  watch.on_position(timed(position_at(200, 0), 2 * s + 1), 2 * s + 1);
  EXPECT_EQ(watch.evaluate(2 * s + 1, false).finding, fence_finding::inside);
}

TEST(fence_watch, a_vehicle_that_tells_its_place_once_a_second_is_seen_outside_as_well) {
  auto watch = within_100_m();
  fence_finding found = fence_finding::inside;
  for (int i = 0; i < 4; ++i) {
    const auto now = i * (s + s / 20);
    watch.on_position(timed(position_at(90.0 + 20 * i, 0), now), now);
    found = watch.evaluate(now, false).finding;
    (void)watch.evaluate(now + s + s / 50, false);
  }
  EXPECT_EQ(found, fence_finding::breached);
}

TEST(fence_watch, a_position_outside_is_a_breach_for_as_long_as_it_is_there) {
  auto watch = within_100_m();
  stays(watch, position_at(200, 0), 0);
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::breached);
  EXPECT_EQ(watch.evaluate(s / 10, false).finding, fence_finding::breached);
}

TEST(fence_watch, the_way_between_two_positions_is_judged_too) {
  auto watch = watch_of({fence_of(fence_kind::exclusion, square(2))});
  watch.on_position(position_at(-5, 0), 0);
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::inside);
  stays(watch, position_at(5, 0), s / 5);
  EXPECT_EQ(watch.evaluate(s / 5, false).finding, fence_finding::breached);
  EXPECT_EQ(watch.evaluate(s / 5, false).finding, fence_finding::inside) << "it is past";
}

TEST(fence_watch, several_positions_between_two_ticks_are_all_judged) {
  auto watch = watch_of({fence_of(fence_kind::exclusion, square(2, 0, 10))});
  watch.on_position(position_at(-5, 0), 0);
  watch.on_position(timed(position_at(-3, 10), s / 50), s / 50);
  watch.on_position(timed(position_at(1, 10), s / 30), s / 30);
  watch.on_position(timed(position_at(3, 10), s / 25), s / 25);
  watch.on_position(position_at(5, 0), s / 20);
  EXPECT_EQ(watch.evaluate(s / 10, false).finding, fence_finding::breached);
}

TEST(fence_watch, over_a_gap_in_the_positions_no_way_is_drawn) {
  auto watch = watch_of({fence_of(fence_kind::exclusion, square(2))});
  watch.on_position(position_at(-5, 0), 0);
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::inside);
  watch.on_position(position_at(5, 0), s + 1);
  EXPECT_EQ(watch.evaluate(s + 1, false).finding, fence_finding::inside);
}

TEST(fence_watch, more_positions_than_there_is_room_for_still_end_where_the_vehicle_is) {
  auto watch = within_100_m();
  for (int i = 0; i < 100; ++i)
    watch.on_position(timed(position_at(2.0 * i, 0), i * ns_per_ms), i * ns_per_ms);
  EXPECT_EQ(watch.evaluate(100 * ns_per_ms, false).finding, fence_finding::breached);
}

TEST(fence_watch, the_predicted_position_2_s_ahead_gives_a_warning_and_no_breach) {
  auto watch = within_100_m();
  watch.on_position(position_at(85, 0, 50, 7), 0);
  EXPECT_FALSE(watch.evaluate(0, false).ahead) << "99 m";
  watch.on_position(position_at(85, 0, 50, 8), s / 10);
  const auto verdict = watch.evaluate(s / 10, false);
  EXPECT_EQ(verdict.finding, fence_finding::inside);
  EXPECT_TRUE(verdict.ahead) << "101 m";
}

TEST(fence_watch, a_climb_towards_the_ceiling_is_predicted) {
  auto watch = watch_of({fence_of(fence_kind::inclusion, square(100), {}, 120)});
  auto climbing = position_at(0, 0, 115);
  climbing.down_mps = -3;
  watch.on_position(climbing, 0);
  EXPECT_TRUE(watch.evaluate(0, false).ahead);
}

TEST(fence_watch, a_speed_that_is_not_a_number_predicts_nothing) {
  auto watch = within_100_m();
  watch.on_position(position_at(85, 0, 50, std::numeric_limits<double>::quiet_NaN()), 0);
  const auto verdict = watch.evaluate(0, false);
  EXPECT_EQ(verdict.finding, fence_finding::inside);
  EXPECT_FALSE(verdict.ahead);
}

TEST(fence_watch, what_is_no_position_gets_old_like_silence) {
  auto watch = within_100_m();
  watch.on_position(position_at(0, 0), 0);
  watch.on_position({.latitude_deg = 0, .longitude_deg = 0, .altitude_m = 50}, s);
  watch.on_position({.latitude_deg = 91, .longitude_deg = 8, .altitude_m = 50}, s);
  watch.on_position({.latitude_deg = 47, .longitude_deg = 8, .altitude_m = std::numeric_limits<double>::infinity()}, s);
  EXPECT_EQ(watch.evaluate(s, false).finding, fence_finding::inside);
  EXPECT_EQ(watch.evaluate(s + 1, false).finding, fence_finding::no_verdict);
}

TEST(fence_watch, new_fences_count_for_the_positions_that_come_then) {
  auto watch = within_100_m();
  watch.on_position(position_at(50, 0), 0);
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::inside);
  watch.set(godwit::geofence::fence_set::build({fence_of(fence_kind::inclusion, square(40))}).value());
  stays(watch, position_at(50, 0), s / 10);
  EXPECT_EQ(watch.evaluate(s / 10, false).finding, fence_finding::breached);
}

TEST(fence_watch, a_floor_counts_from_the_moment_when_it_was_reached) {
  auto watch = watch_of({fence_of(fence_kind::inclusion, square(100), 20, 120)});
  watch.begin_flight();
  watch.on_position(position_at(0, 0, 5), 0);
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::inside) << "it climbs";
  watch.on_position(position_at(0, 0, 25), s);
  EXPECT_EQ(watch.evaluate(s, false).finding, fence_finding::inside);
  stays(watch, position_at(0, 0, 19), 2 * s);
  EXPECT_EQ(watch.evaluate(2 * s, false).finding, fence_finding::breached);
}

TEST(fence_watch, a_floor_does_not_count_while_it_lands) {
  auto watch = watch_of({fence_of(fence_kind::inclusion, square(100), 20, 120)});
  watch.on_position(position_at(0, 0, 25), 0);
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::inside);
  watch.on_position(position_at(0, 0, 10), s);
  EXPECT_EQ(watch.evaluate(s, true).finding, fence_finding::inside);
}

TEST(fence_watch, the_next_flight_has_to_reach_the_floor_again) {
  auto watch = watch_of({fence_of(fence_kind::inclusion, square(100), 20, 120)});
  watch.on_position(position_at(0, 0, 25), 0);
  EXPECT_EQ(watch.evaluate(0, false).finding, fence_finding::inside);
  watch.begin_flight();
  watch.on_position(position_at(0, 0, 1), s);
  EXPECT_EQ(watch.evaluate(s, false).finding, fence_finding::inside);
}

TEST(fence_watch, the_sides_and_the_ceiling_count_from_the_ground_on) {
  auto watch = watch_of({fence_of(fence_kind::inclusion, square(100), 20, 120)});
  stays(watch, position_at(101, 0, 1), 0);
  EXPECT_EQ(watch.evaluate(0, true).finding, fence_finding::breached);
}

TEST(fence_watch, positions_from_before_there_was_a_fence_breach_none) {
  fence_watch watch;
  watch.on_position(timed(position_at(200, 0), 0), 0);
  watch.on_position(timed(position_at(200, 0), s / 4), s / 4);
  EXPECT_EQ(watch.evaluate(s / 4, false).finding, fence_finding::no_fences);
  watch.set(godwit::geofence::fence_set::build({fence_of(fence_kind::inclusion, square(100))}).value());
  watch.on_position(timed(position_at(0, 0), s / 2), s / 2);
  EXPECT_EQ(watch.evaluate(s / 2, false).finding, fence_finding::inside);
}

TEST(fence_watch, where_one_speed_is_not_known_nothing_is_foretold) {
  const auto unknown = std::numeric_limits<double>::quiet_NaN();
  auto watch = within_100_m();
  auto there = position_at(97, 0, 50, 3);
  watch.on_position(there, 0);
  EXPECT_TRUE(watch.evaluate(0, false).ahead);
  for (auto* each : {&there.north_mps, &there.east_mps, &there.down_mps}) {
    const auto known = std::exchange(*each, unknown);
    watch.on_position(there, s / 4);
    EXPECT_FALSE(watch.evaluate(s / 4, false).ahead);
    *each = known;
  }
}

} // namespace fence_watch_test
