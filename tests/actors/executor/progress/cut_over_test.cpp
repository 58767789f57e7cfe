#include "actors/executor/progress/cut_over.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace cut_over_test {

using namespace test;

const assignment_key key{"assignment", "key"};

struct cut_over_any : testing::TestWithParam<flavour> {
  progress_fixture d{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(on, cut_over_any, testing::Values(px4, ardupilot),
                         [](const auto& which) { return which.param.name; });

TEST_P(cut_over_any, one_event_answers_the_assignment_and_swaps_the_plan) {
  d.fly({"A", "B"});
  d.reached(0);
  d.intend(map_of(d.vehicle, {"Z"}, 1), 2, key);
  EXPECT_TRUE(d.answers.empty());
  EXPECT_EQ(d.s.plan->generation.number, 1U);
  const auto came = d.take(upload_ended{upload_verdict::accepted, 101, {}});
  ASSERT_EQ(d.answers.size(), 1U);
  EXPECT_EQ(std::get<assignment_answered>(came.front()).response.last_progress, d.reports.back());
  EXPECT_EQ(d.answers[0].response.generation, 2U);
  EXPECT_EQ(d.answers[0].mission_id, "m");
  EXPECT_EQ(d.s.plan->generation.number, 2U);
  EXPECT_EQ(d.s.plan->vehicle_plan_id, 101U);
  EXPECT_EQ(d.s.plan->map, map_of(d.vehicle, {"Z"}, 1));
  EXPECT_EQ(d.s.mission->revision, 2);
}

TEST_P(cut_over_any, the_answer_tells_no_progress_when_there_was_none) {
  d.upload(map_of(d.vehicle, {"A"}), 1, key);
  EXPECT_FALSE(d.answers.at(0).response.last_progress);
}

TEST_P(cut_over_any, what_was_left_before_it_is_settled_and_is_in_the_answer) {
  d.fly({"A", "B"});
  d.current(1); // A waits for its REACHED
  d.intend(map_of(d.vehicle, {"Z"}, 1), 2, key);
  d.accept();
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1 inferred", "started B#1 g1"}));
  EXPECT_EQ(text_of(*d.answers.at(0).response.last_progress), "started B#1 g1");
}

TEST_P(cut_over_any, from_now_on_all_of_an_older_generation_is_dropped) {
  d.fly({"A", "B"});
  const auto of_old = d.current_message(1);
  d.reached(0);
  d.said();
  d.upload({"X", "Y", "Z"}, 1);
  d.say(of_old);
  d.reached(0);
  d.reached(1);
  EXPECT_EQ(d.said(), texts{});
  EXPECT_FALSE(d.is_armed());
}

TEST_P(cut_over_any, items_of_the_revision_that_nobody_did_and_the_new_plan_leaves_out_are_skipped) {
  d.fly({"A", "B", "C", "D"});
  d.reached(0);
  d.said();
  d.upload({"D"}, 3);
  EXPECT_EQ(d.said(), (texts{"skipped B#1 g2", "skipped C#2 g2"}));
}

TEST_P(cut_over_any, items_that_another_revision_may_have_removed_are_not_reported) {
  d.fly({"A", "B", "C"});
  d.reached(0);
  d.said();
  d.upload(map_of(d.vehicle, {"Z"}, 2), 2);
  EXPECT_EQ(d.said(), texts{});
}

TEST_P(cut_over_any, an_earlier_revision_is_reported_until_then) {
  d.fly({"A", "B"});
  d.intend(map_of(d.vehicle, {"A", "Z"}), 2);
  d.reached(0);
  d.current(0);
  d.accept();
  d.current(0);
  EXPECT_EQ(d.reports.at(1).revision, 1);
  EXPECT_EQ(text_of(d.reports.at(1)), "reached A#0 g1");
  EXPECT_EQ(text_of(d.reports.back()), "started A#0 g2");
  EXPECT_EQ(d.reports.back().revision, 2);
}

TEST_P(cut_over_any, it_ends_a_pause) {
  d.fly({"A", "B"});
  d.take(vehicle_rebooted{});
  d.upload({"A", "B"});
  EXPECT_FALSE(d.s.paused);
  d.current(0);
  EXPECT_TRUE(d.is_armed());
}

TEST(cut_over, a_plan_with_the_same_content_keeps_its_id_and_counts_from_its_start) {
  progress_fixture d;
  d.fly({"A", "B", "C"});
  d.reached(0);
  d.current(1);
  d.said();
  d.intend(map_of(px4, {"A", "B", "C"}));
  d.take(upload_ended{upload_verdict::accepted, d.plan_id, {}});
  d.current(1); // it was not activated: a set-current has to follow
  d.wait_s(3);
  d.current(1);
  EXPECT_EQ(d.said(), texts{});
  EXPECT_EQ(d.news_told().back(), "not_at_start g2");
  d.start_at(1);
  d.started();
  d.current(1);
  EXPECT_EQ(d.said(), (texts{"skipped A#0 g3", "started B#1 g3"}));
}

TEST(cut_over, a_reached_that_is_repeated_over_a_plan_with_the_same_content_counts_nothing) {
  progress_fixture d;
  d.fly({"A"});
  d.reached(0);
  d.said();
  d.intend(map_of(px4, {"A"}), 2);
  d.take(upload_ended{upload_verdict::accepted, d.plan_id, {}});
  for (int i = 0; i < 8; ++i) {
    d.current(0, mission_state::complete);
    d.reached(0);
    d.wait_s(1);
  }
  EXPECT_EQ(d.said(), texts{});
}

TEST(cut_over, a_reached_that_was_lost_does_not_count_for_a_plan_with_the_same_content) {
  progress_fixture d;
  d.fly({"A"});
  d.said();
  d.intend(map_of(px4, {"A"}), 2);
  d.take(upload_ended{upload_verdict::accepted, d.plan_id, {}});
  for (int i = 0; i < 8; ++i) {
    d.current(0, mission_state::complete);
    d.reached(0);
    d.wait_s(1);
  }
  EXPECT_EQ(d.said(), texts{});
}

TEST(cut_over, a_plan_with_the_same_content_is_armed_when_late_messages_are_over) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.intend(map_of(px4, {"A", "B"}), 2);
  d.take(upload_ended{upload_verdict::accepted, d.plan_id, {}});
  d.current(0); // may be late, and the vehicle at B
  EXPECT_FALSE(d.is_armed());
  d.wait_s(2);
  d.current(0);
  EXPECT_TRUE(d.is_armed());
}

TEST(cut_over, in_a_plan_with_the_same_content_commands_in_front_are_not_taken_for_done) {
  auto map = map_of(px4, {"speed", "A", "B"});
  map.items[0].first_nav_sequence.reset();
  map.items[0].last_nav_sequence.reset();
  progress_fixture d;
  d.upload(map);
  d.start_at(1); // the command is skipped
  d.started();
  d.current(1);
  d.wait_s(3);
  d.said();
  d.intend(map, 2);
  d.take(upload_ended{upload_verdict::accepted, d.plan_id, {}});
  d.current(1); // it just goes on
  EXPECT_FALSE(d.is_armed());
  d.wait_s(3);
  d.current(1);
  EXPECT_EQ(d.said(), texts{});
  EXPECT_EQ(d.news_told().back(), "not_at_start g3");
}

TEST(cut_over, plan_id_0_is_none) {
  progress_fixture d;
  d.intend(map_of(px4, {"A"}));
  d.take(upload_ended{upload_verdict::accepted, 0, {}});
  EXPECT_FALSE(d.s.plan->vehicle_plan_id);
}

} // namespace cut_over_test
} // namespace godwit::executor::progress
