// What a vehicle says, and what of it counts.
#include "actors/executor/progress/follow.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace follow_test {

using namespace test;

struct follow_any : testing::TestWithParam<flavour> {
  progress_fixture d{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(on, follow_any, testing::Values(px4, ardupilot),
                         [](const auto& which) { return which.param.name; });

// -- arming -----------------------------------------------------------------------------------------

TEST_P(follow_any, a_generation_counts_only_after_mission_current_at_the_expected_start) {
  d.upload({"A", "B", "C"});
  EXPECT_EQ(d.news_told(), texts{"generation_opened g1"});
  d.wait_s(3);
  d.reached(0);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), texts{});
  d.current(0);
  d.reached(0); // just before it came there, perhaps
  EXPECT_EQ(d.said(), texts{"started A#0 g1"});
  d.wait_s(2);
  d.reached(0);
  EXPECT_EQ(d.said(), texts{"reached A#0 g1"});
}

TEST_P(follow_any, the_old_sequence_just_after_the_switch_counts_nothing) {
  d.fly({"A", "B", "C"});
  d.reached(0);
  d.current(1);
  d.said();
  d.upload({"X", "Y", "Z"}, 1);
  d.current(1);
  d.wait_ms(100);
  d.current(2);
  EXPECT_EQ(d.said(), texts{});
  EXPECT_FALSE(d.is_armed());
  d.current(0);
  EXPECT_TRUE(d.is_armed());
  EXPECT_EQ(d.said(), texts{"started X#1 g2"});
}

TEST_P(follow_any, sequence_65535_is_no_item) {
  d.upload({"A", "B"});
  auto nowhere = d.current_message(0);
  nowhere.seq = no_sequence;
  d.say(nowhere);
  EXPECT_FALSE(d.is_armed());
  d.current(0);
  d.wait_s(3);
  d.say(nowhere);
  EXPECT_EQ(d.said(), texts{"started A#0 g1"});
}

TEST_P(follow_any, a_sequence_that_is_not_below_the_total_is_ignored) {
  d.fly({"A", "B"});
  d.current(2); // one past the last item
  d.wait_s(2);
  d.current(2, mission_state::complete);
  d.wait_s(2);
  d.current(2, mission_state::complete);
  EXPECT_EQ(d.said(), texts{"started A#0 g1"});
}

TEST_P(follow_any, a_repeated_reached_of_the_old_plan_just_after_the_switch_counts_nothing) {
  d.fly({"A", "B"});
  d.reached(0);
  d.said();
  d.upload({"X", "Y"}, 1);
  d.reached(0);
  d.current(0);
  d.reached(0);
  d.wait_ms(1000);
  d.reached(0);
  EXPECT_EQ(d.said(), texts{"started X#1 g2"});
  d.wait_ms(1000);
  d.reached(0); // the vehicle has had its time to come there
  EXPECT_EQ(d.said(), texts{"reached X#1 g2"});
}

TEST_P(follow_any, our_plan_elsewhere_than_at_its_start_is_told_once_and_counts_nothing) {
  d.upload({"A", "B", "C"});
  d.news_told();
  d.current(1);
  EXPECT_EQ(d.news_told(), texts{});
  d.wait_s(2);
  d.current(1);
  d.wait_s(1);
  d.current(1);
  EXPECT_EQ(d.news_told(), texts{"not_at_start g1"});
  d.current(2, mission_state::complete);
  EXPECT_EQ(d.said(), texts{});
}

TEST_P(follow_any, commands_in_front_of_the_first_movement_need_not_be_seen) {
  auto map = map_of(d.vehicle, {"speed", "A", "B"});
  map.items[0].first_nav_sequence.reset();
  map.items[0].last_nav_sequence.reset();
  d.upload(map);
  d.wait_s(2);
  d.current(1, mission_state::not_started);
  EXPECT_TRUE(d.is_armed());
  EXPECT_EQ(d.said(), texts{});
  d.current(1);
  EXPECT_EQ(d.said(), (texts{"reached speed#0 g1 inferred", "started A#1 g1"}));
}

TEST(follow, without_ids_a_late_message_of_the_old_plan_does_not_pass_for_commands_in_front_being_done) {
  progress_fixture d(ardupilot);
  d.fly({"A", "B"});
  d.said();
  auto map = map_of(ardupilot, {"speed", "X"}, 2);
  map.items[0].first_nav_sequence.reset();
  map.items[0].last_nav_sequence.reset();
  d.upload(map, 2);
  d.current(1); // at B still; the new plan has as many items
  EXPECT_FALSE(d.is_armed());
  d.current(0);
  EXPECT_TRUE(d.is_armed());
}

TEST(follow, a_reached_during_an_upload_has_to_count_when_it_is_said) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.start_at(0);
  d.started();
  d.current(0);
  d.said();
  d.intend(map_of(px4, {"X"}, 1));
  d.reached(0); // just after the start: of the flight before it, perhaps
  d.wait_s(3);
  d.current(0);
  EXPECT_EQ(d.said(), texts{});
}

TEST_P(follow_any, the_old_sequence_does_not_pass_for_commands_in_front_being_done) {
  auto map = map_of(d.vehicle, {"speed", "A", "B"});
  map.items[0].first_nav_sequence.reset();
  map.items[0].last_nav_sequence.reset();
  d.upload(map);
  d.current(1, mission_state::complete); // the new plan, and the sequence and the state of the old one
  d.current(0, mission_state::paused);
  d.current(1, mission_state::complete);
  d.wait_s(3);
  d.reached(1);
  d.current(0, mission_state::paused);
  EXPECT_EQ(d.said(), texts{});
  d.current(1);
  d.wait_s(1);
  d.current(1);
  EXPECT_EQ(d.said(), (texts{"reached speed#0 g1 inferred", "started A#1 g1"}));
}

TEST_P(follow_any, on_the_ground_nothing_has_started) {
  d.upload({"A", "B"});
  d.current(0, mission_state::not_started);
  EXPECT_TRUE(d.is_armed());
  d.current(0, mission_state::paused);
  EXPECT_EQ(d.said(), texts{});
  d.current(0);
  d.current(0);
  EXPECT_EQ(d.said(), texts{"started A#0 g1"});
}

TEST(follow, with_plan_ids_only_our_id_arms) {
  progress_fixture d;
  d.upload({"A", "B"});
  auto message = d.current_message(0);
  message.mission_id = 100; // of the plan before
  d.say(message);
  EXPECT_FALSE(d.is_armed());
  message.mission_id = 0;
  d.say(message);
  EXPECT_FALSE(d.is_armed());
  d.current(0);
  EXPECT_TRUE(d.is_armed());
}

TEST(follow, without_plan_ids_the_start_with_the_new_total_arms) {
  progress_fixture d(ardupilot);
  d.fly({"A", "B", "C"});
  const auto of_old = d.current_message(0);
  d.upload({"X", "Y"}, 1);
  d.say(of_old);
  EXPECT_FALSE(d.is_armed());
  d.current(0);
  EXPECT_TRUE(d.is_armed());
}

TEST(follow, an_id_that_the_upload_did_not_bring_is_learned_from_the_arming_message) {
  progress_fixture d;
  d.intend(map_of(px4, {"A", "B"}));
  d.take(upload_ended{upload_verdict::accepted, {}, {}});
  d.total = 2;
  d.current(0); // still 100, the id before
  EXPECT_FALSE(d.is_armed());
  d.plan_id = 555;
  d.current(0);
  EXPECT_TRUE(d.is_armed());
  d.wait_s(3);
  d.plan_id = 556;
  d.current(0);
  EXPECT_EQ(d.s.paused, pause_reason::foreign_plan);
}

TEST(follow, home_of_an_ardupilot_is_no_item_and_no_foreign_plan) {
  progress_fixture d(ardupilot);
  d.upload({"A", "B"});
  d.wait_s(3);
  d.news_told();
  d.current(-1);
  EXPECT_EQ(d.news_told(), texts{});
  d.current(0);
  d.current(-1);
  EXPECT_EQ(d.said(), texts{"started A#0 g1"});
}

// -- REACHED ----------------------------------------------------------------------------------------

TEST_P(follow_any, reached_counts_once) {
  d.fly({"A", "B"});
  d.reached(0);
  d.wait_s(1);
  d.reached(0);
  d.current(1);
  d.reached(0);
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1", "started B#1 g1"}));
}

TEST_P(follow_any, reached_counts_for_the_current_item_and_the_one_just_left_only) {
  d.fly({"A", "B", "C", "D"});
  d.reached(1); // ahead
  EXPECT_EQ(d.said(), texts{"started A#0 g1"});
  d.current(1);
  d.reached(0); // just left
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1", "started B#1 g1"}));
  d.current(2);
  d.wait_s(1);
  d.current(2);
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1 inferred", "started C#2 g1"}));
  d.reached(1);
  d.reached(0); // long gone
  EXPECT_EQ(d.said(), texts{});
}

// -- uploads and starts under way -------------------------------------------------------------------

TEST(follow, the_old_plan_counts_until_the_cut_over_on_a_vehicle_with_ids) {
  progress_fixture d;
  d.fly({"A", "B", "C"});
  d.intend(map_of(px4, {"X"}, 2));
  d.reached(0);
  EXPECT_EQ(d.said(), texts{"started A#0 g1"}); // of which plan is not known yet
  d.current(1);
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1", "started B#1 g1"}));
}

TEST(follow, a_reached_that_nothing_confirms_before_the_new_id_is_dropped) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.said();
  d.intend(map_of(px4, {"X", "Y"}, 1));
  d.reached(0);
  auto of_new = d.current_message(0);
  of_new.mission_id = d.plan_id + 1;
  d.say(of_new);
  d.reached(0);
  d.accept();
  EXPECT_EQ(d.said(), (texts{"skipped A#0 g2", "started X#1 g2"})); // and not reached
}

TEST(follow, mission_current_with_the_new_id_before_the_ack_is_held_and_looked_at_after_the_cut_over) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.said();
  d.intend(map_of(px4, {"X", "Y"}, 1));
  auto of_new = d.current_message(1); // with the old sequence
  of_new.mission_id = d.plan_id + 1;
  d.say(of_new);
  of_new.seq = 0;
  d.say(of_new);
  EXPECT_EQ(d.said(), texts{});
  EXPECT_EQ(d.s.held.size(), 2U);
  d.accept();
  EXPECT_TRUE(d.is_armed());
  EXPECT_TRUE(d.s.held.empty());
  EXPECT_EQ(d.said(), (texts{"skipped A#0 g2", "started X#1 g2"}));
}

TEST(follow, what_is_held_is_bounded_and_a_repetition_is_held_once) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.intend(map_of(px4, {"X", "Y"}, 1));
  auto of_new = d.current_message(0);
  for (std::uint32_t i = 0; i < 20; ++i) {
    of_new.mission_id = d.plan_id + 1 + i / 2;
    d.say(of_new);
  }
  EXPECT_EQ(d.s.held.size(), max_held);
  EXPECT_EQ(d.s.dropped_held, 4U); // two more ids, twice each
  d.accept();
  EXPECT_TRUE(d.is_armed()); // the oldest ones were kept
}

TEST(follow, a_foreign_id_during_an_upload_is_judged_after_it) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.intend(map_of(px4, {"X"}, 1));
  auto foreign = d.current_message(0);
  foreign.mission_id = 7;
  d.say(foreign);
  d.accept();
  EXPECT_FALSE(d.s.paused);
  d.wait_s(2);
  d.say(foreign);
  EXPECT_EQ(d.s.paused, pause_reason::foreign_plan);
}

TEST(follow, a_vehicle_without_ids_is_held_during_an_upload_and_only_its_reached_means_something) {
  progress_fixture d(ardupilot);
  d.fly({"A", "B"});
  d.intend(map_of(ardupilot, {"X", "Y"}, 1));
  d.current(1);
  d.wait_s(2);
  d.current(1);
  EXPECT_EQ(d.said(), texts{"started A#0 g1"});
  d.reached(0);
  EXPECT_EQ(d.said(), texts{"reached A#0 g1"});
}

// -- foreign hands and restarts ---------------------------------------------------------------------

TEST_P(follow_any, a_plan_of_a_foreign_hand_pauses_with_a_reason_and_nothing_counts) {
  d.fly({"A", "B"});
  d.said();
  d.news_told();
  auto foreign = d.current_message(1);
  foreign.mission_id += d.vehicle.has_ids ? 17 : 0;
  foreign.total = 5;
  d.say(foreign);
  EXPECT_EQ(d.s.paused, pause_reason::foreign_plan);
  EXPECT_EQ(d.news_told(), texts{"foreign_plan g1"});
  EXPECT_FALSE(d.told.back().reason.empty());
  d.say(foreign);
  d.reached(0);
  d.reached(1);
  d.current(1); // ours again, for what reason ever
  d.wait_s(2);
  d.current(1, mission_state::complete);
  EXPECT_EQ(d.said(), texts{});
  EXPECT_EQ(d.news_told(), texts{});
}

TEST_P(follow_any, a_plan_that_was_cleared_by_a_foreign_hand_pauses_too) {
  d.fly({"A", "B"});
  d.say({.seq = 0, .total = static_cast<std::uint16_t>(d.vehicle.has_ids ? 65535 : 0), .mission_state = 1});
  EXPECT_EQ(d.s.paused, pause_reason::foreign_plan);
}

TEST_P(follow_any, old_news_of_the_plan_before_is_no_foreign_hand) {
  d.fly({"A", "B", "C"});
  const auto late = d.current_message(1);
  d.upload({"X"}, 1);
  d.wait_ms(1900);
  d.say(late);
  EXPECT_FALSE(d.s.paused);
  d.wait_ms(200);
  d.say(late); // the old plan is back on the vehicle
  EXPECT_EQ(d.s.paused, pause_reason::foreign_plan);
}

TEST_P(follow_any, a_restart_of_the_vehicle_pauses_and_nothing_counts_until_the_next_start) {
  d.fly({"A", "B"});
  d.reached(0);
  d.current(1);
  d.said();
  d.news_told();
  d.take(vehicle_rebooted{});
  EXPECT_EQ(d.s.paused, pause_reason::vehicle_restarted);
  EXPECT_EQ(d.news_told(), texts{"vehicle_restarted g1"});
  d.current(0);
  d.wait_s(3);
  d.reached(0);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), texts{});
  d.start_at(1);
  d.started();
  d.current(1);
  EXPECT_EQ(d.said(), texts{"started B#1 g2"});
}

TEST(follow, a_restart_of_a_vehicle_without_a_plan_of_ours_is_nothing) {
  progress_fixture d;
  d.take(vehicle_rebooted{});
  EXPECT_FALSE(d.s.paused);
}

} // namespace follow_test
} // namespace godwit::executor::progress
