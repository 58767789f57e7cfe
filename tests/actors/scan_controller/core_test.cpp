#include "actors/scan_controller/core.hpp"

#include <gtest/gtest.h>

#include "tests/actors/scan_controller/scan_world.hpp"

namespace scan_controller_core_test {

using namespace godwit;
using namespace godwit::scan_controller;
using namespace godwit::test;

using numbers = std::vector<std::uint64_t>;

TEST(scan_core, what_is_seen_first_is_shown_at_once) {
  scan_world w;
  EXPECT_EQ(w.see(thing(1)).fate, candidate_fate::opened);
  EXPECT_EQ(w.shown(), numbers{1});
  ASSERT_EQ(w.effects.size(), 1U);
  EXPECT_EQ(std::get<point_shown>(w.effects[0]).number, 1U);
}

TEST(scan_core, at_most_five_are_shown_in_a_minute_and_the_sixth_right_after_it) {
  scan_world w;
  for (int i = 1; i <= 6; ++i)
    w.see(thing(i));
  EXPECT_EQ(w.state.shown.size(), 5U);
  w.wait(60 * second);
  EXPECT_EQ(w.state.shown_ns.size(), 5U) << "both ends of the minute count";
  w.wait(1);
  EXPECT_EQ(w.shown(), numbers{6});
}

TEST(scan_core, what_is_below_the_threshold_is_never_shown_until_it_is_seen_better) {
  scan_world w;
  w.see(thing(1, 0.39));
  EXPECT_TRUE(w.shown().empty());
  EXPECT_EQ(w.see(thing(1, 0.4)).fate, candidate_fate::merged);
  EXPECT_EQ(w.shown(), numbers{1});
}

TEST(scan_core, below_the_threshold_it_is_dropped_when_it_was_not_seen_for_long) {
  scan_world w;
  w.see(thing(1, 0.3));
  w.wait(601 * second);
  EXPECT_TRUE(w.state.waiting.empty());
  EXPECT_EQ(w.state.counts.too_faint, 1U);
}

TEST(scan_core, the_same_class_near_by_is_the_same_point) {
  scan_world w;
  w.see(thing(1));
  auto again = thing(1);
  again.id = sighting_id(2);
  again.position.latitude_deg += 0.0002; // 22 m
  EXPECT_EQ(w.see(again).fate, candidate_fate::merged);
  auto other = again;
  other.class_group = "person";
  EXPECT_EQ(w.see(other).fate, candidate_fate::opened);
}

TEST(scan_core, an_object_that_moves_away_stays_the_same_point) {
  scan_world w;
  auto first = thing(1);
  first.object_id = sighting_id(1);
  w.see(first);
  auto moved = thing(20);
  moved.object_id = sighting_id(1);
  moved.has_moved = true;
  EXPECT_EQ(w.see(moved).fate, candidate_fate::merged);
  EXPECT_TRUE(w.state.shown.front().what.has_moved);
  EXPECT_EQ(w.state.shown.front().what.position.latitude_deg, moved.position.latitude_deg);
}

TEST(scan_core, a_known_object_at_its_place_opens_nothing_and_refreshes_what_is_there) {
  scan_world w;
  auto known = thing(1);
  known.is_known = true;
  EXPECT_EQ(w.see(known).fate, candidate_fate::known);
  w.see(thing(1, 0.3));
  EXPECT_EQ(w.see(known).fate, candidate_fate::merged);
  EXPECT_EQ(w.shown(), numbers{1});
}

TEST(scan_core, the_best_of_those_that_wait_has_the_next_turn) {
  scan_world w({.shown_a_minute = 1});
  w.see(thing(1));
  w.see(thing(2, 0.5));
  w.see(thing(3, 0.8));
  auto moves = thing(4, 0.7);
  moves.has_moved = true;
  w.see(moves);
  w.wait(61 * second);
  EXPECT_EQ(w.shown(), numbers{4}) << "0.7 and it moves";
  w.wait(61 * second);
  EXPECT_EQ(w.shown(), numbers{3});
}

TEST(scan_core, a_window_is_over_at_its_nanosecond) {
  scan_world w;
  w.see(thing(1));
  w.now_ns += 60 * second - 1;
  EXPECT_TRUE(w.say(1, decision::confirm).is_taken);
  w.see(thing(2));
  w.now_ns += 60 * second;
  EXPECT_FALSE(w.say(2, decision::confirm).is_taken) << "nobody has looked at the clock meanwhile";
  w.turn();
  EXPECT_EQ(w.state.counts.passed_over, 1U);
}

TEST(scan_core, a_decision_is_owed_to_the_map_and_a_time_out_is_not) {
  scan_world w;
  w.see(thing(1));
  w.see(thing(2));
  w.see(thing(3));
  EXPECT_TRUE(w.say(1, decision::confirm).is_taken);
  EXPECT_TRUE(w.say(2, decision::decline).is_taken);
  w.wait(61 * second);
  ASSERT_EQ(w.state.owed.size(), 2U);
  EXPECT_EQ(w.state.owed[0].said, mapobjects_store::verdict::confirmed);
  EXPECT_EQ(w.state.owed[1].said, mapobjects_store::verdict::declined);
  EXPECT_NE(w.state.owed[0].id, w.state.owed[1].id);
}

TEST(scan_core, a_decision_said_again_is_answered_the_same_and_another_one_is_refused) {
  scan_world w;
  w.see(thing(1));
  EXPECT_TRUE(w.say(1, decision::decline).is_taken);
  EXPECT_TRUE(w.say(1, decision::decline).is_taken);
  EXPECT_EQ(w.state.owed.size(), 1U);
  const auto other = w.say(1, decision::confirm, "bert");
  EXPECT_FALSE(other.is_taken);
  EXPECT_NE(other.reason.find("declined by anna"), std::string::npos) << other.reason;
}

TEST(scan_core, who_decides_about_a_point_that_waits_or_is_none_is_told_so) {
  scan_world w({.shown_a_minute = 1});
  w.see(thing(1));
  w.see(thing(2));
  EXPECT_NE(w.say(2, decision::confirm).reason.find("not shown yet"), std::string::npos);
  EXPECT_NE(w.say(7, decision::confirm).reason.find("no point 7"), std::string::npos);
}

TEST(scan_core, no_decision_is_taken_while_the_map_owes_answers_to_too_many) {
  scan_world w;
  w.see(thing(1));
  w.state.owed.resize(max_owed);
  EXPECT_FALSE(w.say(1, decision::decline).is_taken);
  w.state.owed.clear();
  EXPECT_TRUE(w.say(1, decision::decline).is_taken);
}

TEST(scan_core, what_was_decided_is_not_shown_again) {
  scan_world w;
  w.see(thing(1));
  ASSERT_TRUE(w.say(1, decision::decline).is_taken);
  EXPECT_EQ(w.see(thing(1)).fate, candidate_fate::resolved);
  w.wait(3'600 * second);
  EXPECT_EQ(w.see(thing(1)).fate, candidate_fate::resolved);
}

TEST(scan_core, what_was_passed_over_is_shown_again_when_it_is_seen_long_after) {
  scan_world w;
  w.see(thing(1));
  w.wait(61 * second);
  auto known = thing(1);
  known.is_known = true;
  EXPECT_EQ(w.see(known).fate, candidate_fate::resolved);
  w.wait(601 * second);
  EXPECT_EQ(w.see(known).fate, candidate_fate::opened);
  EXPECT_EQ(w.shown(), numbers{2});
}

TEST(scan_core, when_all_room_is_taken_the_one_that_is_worth_least_is_dropped) {
  scan_world w({.shown_a_minute = 1});
  w.see(thing(0));
  for (int i = 1; i <= static_cast<int>(max_waiting); ++i)
    w.see(thing(i, 0.5 + 0.001 * i));
  EXPECT_EQ(w.see(thing(100, 0.45)).fate, candidate_fate::no_room);
  EXPECT_EQ(w.see(thing(101, 0.95)).fate, candidate_fate::opened);
  EXPECT_EQ(w.state.waiting.size(), max_waiting);
  EXPECT_EQ(w.state.counts.no_room, 2U);
  EXPECT_EQ(w.state.waiting.front().number, 3U) << "the second had the least confidence";
}

TEST(scan_core, what_was_seen_too_long_ago_is_dropped_and_counted) {
  scan_world w;
  auto old = thing(1);
  old.at_ns = w.now().wall_ns - 601 * second;
  EXPECT_EQ(w.see_as_dated(old).fate, candidate_fate::too_old);
  EXPECT_EQ(w.state.counts.too_old, 1U);
  EXPECT_EQ(w.state.counts.opened, 1U);
}

TEST(scan_core, what_is_dated_in_the_future_was_seen_now) {
  scan_world w;
  auto ahead = thing(1);
  ahead.at_ns = w.now().wall_ns + 3'600 * second;
  EXPECT_EQ(w.see_as_dated(ahead).fate, candidate_fate::opened);
  EXPECT_EQ(w.state.shown.front().what.seen_ns, w.now_ns);
}

TEST(scan_core, another_mission_drops_what_waits_and_passes_over_what_is_shown_but_keeps_the_rate) {
  scan_world w;
  for (int i = 1; i <= 6; ++i)
    w.see(thing(i));
  auto next = thing(9);
  next.mission_id = "00000000-1111-4000-8000-000000000000";
  EXPECT_EQ(w.see(next).fate, candidate_fate::opened);
  EXPECT_EQ(w.state.counts.passed_over, 5U);
  EXPECT_EQ(w.state.counts.mission_over, 1U);
  EXPECT_TRUE(w.shown().empty()) << "five were shown within this minute";
  w.wait(61 * second);
  EXPECT_EQ(w.shown(), numbers{7});
}

TEST(scan_core, after_a_start_of_the_computer_no_time_has_passed) {
  scan_world w;
  for (int i = 1; i <= 6; ++i)
    w.see(thing(i));
  w.now_ns = 5 * second; // another boot
  const auto restarted = core::on_start(w.state, w.now());
  ASSERT_TRUE(restarted);
  w.apply(*restarted);
  w.turn();
  EXPECT_EQ(w.state.shown.size(), 5U);
  w.wait(60 * second - 1);
  EXPECT_EQ(w.state.shown.size(), 5U) << "their windows last";
  w.wait(2);
  EXPECT_EQ(w.shown(), numbers{6});
  EXPECT_FALSE(core::on_start(w.state, w.now()));
}

TEST(scan_core, the_view_has_what_is_shown_what_is_confirmed_and_how_long_there_is) {
  scan_world w;
  w.see(thing(1));
  w.see(thing(2));
  ASSERT_TRUE(w.say(1, decision::confirm).is_taken);
  w.wait(10 * second);
  const auto seen = core::view_of(w.state, w.now());
  ASSERT_EQ(seen.shown.size(), 1U);
  EXPECT_EQ(seen.shown[0].decide_within_ms, 50'000);
  EXPECT_EQ(seen.shown[0].seen_ago_ms, 10'000);
  ASSERT_EQ(seen.confirmed.size(), 1U);
  EXPECT_EQ(seen.confirmed[0].by, "anna");
}

} // namespace scan_controller_core_test
