// MISSION_START and set-current: each that is accepted opens a new generation.
#include "actors/executor/progress/start.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace start_test {

using namespace test;

struct start_any : testing::TestWithParam<flavour> {
  void SetUp() override {
    d.fly({"A", "B", "C", "D"});
    d.reached(0);
    d.current(1);
    d.wait_s(1);
    d.said();
    d.news_told();
  }

  progress_fixture d{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(on, start_any, testing::Values(px4, ardupilot),
                         [](const auto& which) { return which.param.name; });

TEST_P(start_any, an_accepted_start_opens_a_new_generation_that_is_not_armed_yet) {
  d.start_at(1);
  EXPECT_TRUE(d.is_armed());
  d.started();
  EXPECT_EQ(d.news_told(), texts{"generation_opened g2"});
  EXPECT_FALSE(d.is_armed());
  d.reached(1);
  EXPECT_EQ(d.said(), texts{});
  d.current(1);
  EXPECT_EQ(d.said(), texts{"started B#1 g2"});
}

TEST_P(start_any, items_that_a_set_current_jumps_over_are_reported_skipped) {
  d.start_at(3);
  d.started();
  EXPECT_EQ(d.said(), (texts{"skipped B#1 g2", "skipped C#2 g2"}));
  d.current(3);
  EXPECT_EQ(d.said(), texts{"started D#3 g2"});
}

TEST_P(start_any, a_jump_that_is_seen_before_its_answer_is_not_taken_for_progress) {
  d.start_at(3);
  d.current(3);
  d.wait_s(2);
  d.current(3);
  EXPECT_EQ(d.said(), texts{});
  d.started();
  EXPECT_EQ(d.said(), (texts{"skipped B#1 g2", "skipped C#2 g2", "started D#3 g2"}));
  EXPECT_TRUE(d.is_armed()); // by what was held
}

TEST_P(start_any, a_start_in_a_generation_that_is_not_armed_arms_only_the_next_one) {
  auto map = map_of(d.vehicle, {"light", "X"}, 4);
  map.items[0].first_nav_sequence.reset();
  map.items[0].last_nav_sequence.reset();
  d.upload(map, 2);
  d.start_at(1); // over "light", which else would belong to the start
  d.current(1);
  EXPECT_EQ(d.said(), texts{});
  d.started();
  EXPECT_EQ(d.said(), (texts{"skipped light#4 g3", "started X#5 g3"}));
}

TEST_P(start_any, a_start_where_the_vehicle_is_counts_from_its_answer_on) {
  d.upload(map_of(d.vehicle, {"X", "Y"}, 4), 2);
  d.current(0, mission_state::not_started);
  d.start_at(0);
  d.current(0);
  EXPECT_EQ(d.said(), texts{});
  d.started();
  EXPECT_EQ(d.said(), texts{"started X#4 g3"});
}

TEST_P(start_any, old_news_that_was_held_is_no_news_when_a_start_is_refused) {
  d.upload(map_of(d.vehicle, {"X"}, 4), 2);
  d.current(0);
  d.said();
  d.start_at(0);
  d.current(0, mission_state::complete); // of the plan before
  d.wait_s(3);
  d.started(false);
  d.current(0);
  d.wait_s(2);
  d.current(0);
  EXPECT_EQ(d.said(), texts{});
}

TEST_P(start_any, a_reached_after_the_place_of_a_start_may_be_of_it_and_does_not_count_before_its_answer) {
  d.start_at(2);
  d.current(2);
  d.reached(2);
  EXPECT_EQ(d.said(), texts{});
  d.started();
  EXPECT_EQ(d.said(), (texts{"skipped B#1 g2", "started C#2 g2"}));
}

TEST_P(start_any, its_own_progress_goes_on_until_the_answer) {
  d.start_at(3);
  d.reached(1);
  d.current(2);
  d.started();
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1", "started C#2 g1", "skipped C#2 g2"}));
}

TEST_P(start_any, a_refused_start_changes_nothing_and_what_was_held_counts_when_it_is_said_again) {
  d.start_at(2);
  d.reached(1);
  d.current(2);
  EXPECT_EQ(d.said(), texts{"reached B#1 g1"});
  d.started(false);
  EXPECT_EQ(d.said(), texts{});
  d.current(2);
  EXPECT_EQ(d.said(), texts{"started C#2 g1"});
  EXPECT_EQ(d.s.last_generation, 1U);
}

TEST_P(start_any, going_back_reports_again_and_forward_over_what_was_done_skips_nothing) {
  d.reached(1);
  d.start_at(0);
  d.current(0);
  d.started();
  d.wait_s(3);
  d.reached(0);
  EXPECT_EQ(d.said(), (texts{"reached B#1 g1", "started A#0 g2", "reached A#0 g2"}));
  d.start_at(3);
  d.started();
  EXPECT_EQ(d.said(), texts{"skipped C#2 g3"});
}

TEST_P(start_any, the_old_sequence_after_a_start_counts_nothing) {
  d.start_at(0);
  d.started();
  d.current(0);
  d.current(1); // late, of the generation before
  d.wait_ms(1900);
  d.current(1);
  EXPECT_EQ(d.said(), texts{"started A#0 g2"});
  EXPECT_EQ(d.s.plan->generation.current, d.sequence(0));
}

TEST(start, a_reached_that_is_only_repeated_after_a_start_counts_nothing) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.reached(0);
  d.current(1);
  d.reached(1);
  d.current(1, mission_state::complete);
  d.said();
  d.start_at(1); // it is there, and flies nothing
  d.started();
  d.current(1, mission_state::complete);
  for (int i = 0; i < 8; ++i) {
    d.wait_s(1);
    d.reached(1);
    d.current(1, mission_state::complete);
  }
  EXPECT_EQ(d.said(), texts{});
}

TEST(start, a_reached_that_was_never_told_before_a_start_counts_nothing_while_the_vehicle_says_complete) {
  progress_fixture d;
  d.fly({"A"});
  d.said();
  d.current(0, mission_state::complete);
  d.take(mission_aborted{});
  EXPECT_EQ(d.said(), (texts{"reached A#0 g1 inferred", "complete g1 inferred"}));
  d.start_at(0);
  d.started();
  for (int i = 0; i < 8; ++i) {
    d.current(0, mission_state::complete);
    d.reached(0);
    d.wait_s(1);
  }
  EXPECT_EQ(d.said(), texts{});
}

TEST(start, an_item_that_is_flown_again_at_once_is_inferred_because_its_reached_may_be_a_repetition) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.reached(0);
  d.said();
  d.start_at(0);
  d.started();
  d.current(0);
  d.wait_s(3);
  d.reached(0);
  d.current(1);
  d.wait_s(1);
  d.reached(0);
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(),
            (texts{"started A#0 g2", "reached A#0 g2 inferred", "started B#1 g2", "reached B#1 g2", "complete g2"}));
}

TEST(start, a_vehicle_without_ids_says_reached_once_and_it_counts_after_a_start_too) {
  progress_fixture d(ardupilot);
  d.fly({"A", "B"});
  d.reached(0);
  d.said();
  d.start_at(0);
  d.started();
  d.current(0);
  d.wait_s(3);
  d.reached(0);
  EXPECT_EQ(d.said(), (texts{"started A#0 g2", "reached A#0 g2"}));
}

TEST_P(start_any, where_the_vehicle_is_sent_back_to_commands_it_is_seen_after_them_and_that_is_held) {
  auto map = map_of(d.vehicle, {"light", "X"}, 4);
  map.items[0].first_nav_sequence.reset();
  map.items[0].last_nav_sequence.reset();
  d.upload(map, 2);
  d.current(1);
  d.wait_s(3);
  d.said();
  d.start_at(0); // and is not seen there, because commands take no time
  d.current(1);
  d.started();
  EXPECT_EQ(d.said(), (texts{"reached light#4 g3 inferred", "started X#5 g3"}));
}

TEST_P(start_any, a_restart_with_a_start_under_way_has_it_settled) {
  d.start_at(2);
  d.questions.clear();
  d.crash();
  ASSERT_EQ(d.questions.size(), 1U);
  EXPECT_EQ(std::get<resolve_start>(d.questions[0]).sequence, d.sequence(2));
  d.started();
  EXPECT_EQ(d.said(), texts{"skipped B#1 g2"});
}

TEST_P(start_any, an_answer_without_a_start_changes_nothing) {
  EXPECT_TRUE(d.take(start_ended{true}).empty());
  EXPECT_EQ(d.s.last_generation, 1U);
}

TEST_P(start_any, a_foreign_plan_does_not_become_ours_by_a_start) {
  d.start_at(2);
  auto foreign = d.current_message(1);
  foreign.total = 9;
  foreign.mission_id += d.vehicle.has_ids ? 17 : 0;
  d.say(foreign);
  d.started();
  EXPECT_EQ(d.s.paused, pause_reason::foreign_plan);
  d.current(2);
  EXPECT_FALSE(d.is_armed());
  EXPECT_EQ(d.said(), texts{});
}

TEST(start, one_that_nobody_here_has_made_counts_from_the_item_at_which_it_is_found) {
  progress_fixture d;
  d.upload({"A", "B", "C"});
  d.wait_s(5);
  d.take(found_begun{d.sequence(1)});
  d.current(1);
  d.wait_s(5);
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"skipped A#0 g2", "started B#1 g2", "reached B#1 g2"}));
}

// It has failed, because nobody heard it obeyed.
TEST(start, one_that_was_made_here_counts_from_its_item_wherever_it_is_found) {
  for (const bool was_beyond : {false, true}) {
    progress_fixture d;
    d.upload({"A", "B", "C", "D"});
    d.wait_s(5);
    d.take(start_intended{d.sequence(0), false, was_beyond});
    d.take(start_ended{false});
    d.wait_s(30);
    d.take(found_begun{d.sequence(2)});
    d.current(2);
    d.wait_s(5);
    d.current(2);
    d.wait_s(1);
    d.reached(2);
    const texts found{"skipped A#0 g2", "skipped B#1 g2", "started C#2 g2", "reached C#2 g2"};
    const texts followed{"reached A#0 g2 inferred", "reached B#1 g2 inferred", "reached C#2 g2"};
    EXPECT_EQ(d.said(), was_beyond ? found : followed);
  }
}

// The line comes back in the moment before an item is reached: the vehicle is not turned round.
TEST(start, one_that_is_found_and_goes_on_at_once_is_followed_and_not_sent_back) {
  progress_fixture d;
  d.upload({"A", "B", "C", "D"});
  d.wait_s(5);
  d.take(found_begun{d.sequence(1)});
  d.current(2);
  d.wait_s(3);
  d.current(2);
  d.wait_s(3);
  d.current(2);
  EXPECT_EQ(d.said(), (texts{"skipped A#0 g2", "reached B#1 g2 inferred", "started C#2 g2"}));
  for (const auto& each : d.news_told())
    EXPECT_EQ(each.find("not_at_start"), std::string::npos) << each;
}

TEST(start, one_that_nobody_here_has_made_and_that_is_at_its_start_opens_nothing) {
  progress_fixture d;
  d.upload({"A", "B", "C"});
  d.wait_s(5);
  d.take(found_begun{d.sequence(0)});
  EXPECT_EQ(d.s.last_generation, 1U);
  d.current(0);
  d.take(found_begun{d.sequence(2)});
  EXPECT_EQ(d.s.last_generation, 1U) << "it is followed already";
}

TEST(start, one_that_is_found_active_is_complete_also_when_nothing_is_heard_before_that) {
  progress_fixture d;
  d.upload({"A", "B", "C"});
  d.wait_s(5);
  d.take(found_begun{d.sequence(2), true});
  for (int i = 0; i < 3; ++i) {
    d.wait_s(60);
    d.current(2, mission_state::complete);
  }
  EXPECT_EQ(d.said(), (texts{"skipped A#0 g2", "skipped B#1 g2", "reached C#2 g2 inferred", "complete g2 inferred"}));
}

// What it completed before it was started is not what it flies now.
TEST(start, one_that_is_found_and_not_active_is_not_complete_by_what_the_vehicle_reported_before) {
  progress_fixture d;
  d.upload({"A", "B", "C"});
  d.wait_s(5);
  d.take(found_begun{d.sequence(2), false});
  for (int i = 0; i < 3; ++i) {
    d.wait_s(60);
    d.current(2, mission_state::complete);
  }
  EXPECT_EQ(d.said(), (texts{"skipped A#0 g2", "skipped B#1 g2"}));
}

TEST(start, of_a_vehicle_that_was_not_beyond_it_is_believed_when_it_is_heard_further_on) {
  for (const bool was_beyond : {false, true}) {
    progress_fixture d;
    d.upload({"A", "B", "C", "D"});
    d.wait_s(5);
    d.take(start_intended{d.sequence(0), true, was_beyond});
    d.started();
    d.wait_s(1);
    d.current(2);
    EXPECT_EQ(d.said(), texts{}) << "it may be older";
    d.wait_s(2);
    d.current(2);
    d.wait_s(2);
    d.current(2);
    const texts all{"reached A#0 g2 inferred", "reached B#1 g2 inferred", "started C#2 g2"};
    EXPECT_EQ(d.said(), was_beyond ? texts{} : all);
    EXPECT_EQ(d.news_told().back(), was_beyond ? "not_at_start g2" : "armed g2");
  }
}

TEST(start, of_an_incomplete_plan_is_over_when_the_vehicle_reports_that_it_is_complete) {
  for (const bool was_incomplete : {true, false}) {
    progress_fixture d;
    d.upload(texts{"A"});
    d.wait_s(5);
    d.take(start_intended{d.sequence(0), was_incomplete});
    d.started();
    for (int i = 0; i < 4; ++i) {
      d.wait_s(3);
      d.current(0, mission_state::complete);
    }
    EXPECT_EQ(d.said(), (was_incomplete ? texts{"reached A#0 g2 inferred", "complete g2 inferred"} : texts{}));
  }
}

} // namespace start_test
} // namespace godwit::executor::progress
