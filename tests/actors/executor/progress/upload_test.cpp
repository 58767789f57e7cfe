// Upload intents, how they end, and how a restart resolves them.
#include "actors/executor/progress/upload.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/progress/progress_fixture.hpp"

namespace godwit::executor::progress {
namespace upload_test {

using namespace test;

const assignment_key assigned_key{"assignment", "key"};

struct upload_any : testing::TestWithParam<flavour> {
  // A flies, and the upload of X was under way when the process died.
  void SetUp() override {
    d.fly({"A", "B"});
    d.reached(0);
    d.intend(map_of(d.vehicle, {"X"}, 1), 2, assigned_key);
    d.crash();
    d.said();
    d.news_told();
  }

  progress_fixture d{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(on, upload_any, testing::Values(px4, ardupilot),
                         [](const auto& which) { return which.param.name; });

TEST_P(upload_any, the_intent_is_kept_before_anything_is_sent) {
  ASSERT_TRUE(d.s.upload);
  EXPECT_EQ(d.s.upload->generation, 2U);
  EXPECT_EQ(d.s.upload->intent.map, map_of(d.vehicle, {"X"}, 1));
  EXPECT_EQ(d.s.upload->intent.id_before, d.vehicle.has_ids ? std::optional(d.plan_id) : std::nullopt);
}

TEST_P(upload_any, a_restart_with_a_pending_upload_looks_at_the_vehicle) {
  ASSERT_EQ(d.questions.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<look_at_vehicle>(d.questions[0]));
}

TEST_P(upload_any, after_a_restart_a_plan_that_is_read_back_and_matches_is_cut_over_to) {
  d.take(vehicle_looked_at{d.vehicle.has_ids ? std::optional(555U) : std::nullopt});
  EXPECT_TRUE(std::holds_alternative<read_plan_back>(d.questions.back()));
  d.take(plan_read_back{read_back_match::pending});
  EXPECT_FALSE(d.s.upload);
  EXPECT_EQ(d.s.plan->generation.number, 2U);
  EXPECT_EQ(d.s.plan->vehicle_plan_id, d.vehicle.has_ids ? std::optional(555U) : std::nullopt);
  EXPECT_EQ(d.answers.at(0).response.outcome, mission::assignment_outcome::accepted);
}

TEST_P(upload_any, after_a_restart_a_foreign_plan_pauses_with_a_reason_and_the_assignment_is_rejected) {
  d.take(vehicle_looked_at{d.vehicle.has_ids ? std::optional(555U) : std::nullopt});
  d.take(plan_read_back{read_back_match::other});
  EXPECT_FALSE(d.s.upload);
  EXPECT_EQ(d.s.paused, pause_reason::foreign_plan);
  EXPECT_EQ(d.answers.at(0).response.outcome, mission::assignment_outcome::rejected);
  EXPECT_EQ(d.news_told(), (texts{"upload_failed g1", "foreign_plan g1"}));
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), texts{});
}

TEST_P(upload_any, after_a_restart_the_plan_before_means_that_the_upload_failed) {
  d.take(vehicle_looked_at{});
  d.take(plan_read_back{read_back_match::before});
  EXPECT_FALSE(d.s.upload);
  EXPECT_FALSE(d.s.paused);
  EXPECT_EQ(d.news_told(), texts{"upload_failed g1"});
}

TEST_P(upload_any, a_failed_upload_leaves_the_plan_before_in_force_and_rejects_the_assignment) {
  d.take(upload_ended{upload_verdict::unchanged, {}, "no space"});
  EXPECT_EQ(d.answers.at(0).response.outcome, mission::assignment_outcome::rejected);
  EXPECT_EQ(d.answers.at(0).response.reason, "no space");
  EXPECT_EQ(d.answers.at(0).response.generation, 1U);
  EXPECT_EQ(text_of(*d.answers.at(0).response.last_progress), "reached A#0 g1");
  d.current(1);
  d.reached(1);
  EXPECT_EQ(d.said(), (texts{"started B#1 g1", "reached B#1 g1", "complete g1"}));
}

TEST_P(upload_any, an_upload_that_ended_nobody_knows_how_is_settled_by_looking) {
  d.questions.clear();
  d.take(upload_ended{upload_verdict::unknown, {}, "timed out"});
  ASSERT_EQ(d.questions.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<look_at_vehicle>(d.questions[0]));
  EXPECT_TRUE(d.s.upload);
  EXPECT_TRUE(d.answers.empty());
}

TEST_P(upload_any, a_vehicle_that_was_seen_to_hold_neither_plan_is_paused) {
  d.take(upload_ended{upload_verdict::other, {}, {}});
  EXPECT_EQ(d.s.paused, pause_reason::foreign_plan);
  EXPECT_FALSE(d.answers.at(0).response.reason->empty());
}

TEST_P(upload_any, an_answer_that_comes_again_changes_nothing) {
  d.accept();
  const auto before = d.s;
  EXPECT_TRUE(d.take(upload_ended{upload_verdict::accepted, 101, {}}).empty());
  EXPECT_TRUE(d.take(upload_ended{upload_verdict::unchanged, {}, "late"}).empty());
  EXPECT_TRUE(d.take(vehicle_looked_at{101}).empty());
  EXPECT_TRUE(d.take(plan_read_back{read_back_match::other}).empty());
  EXPECT_TRUE(io::equal(d.s, before));
}

TEST_P(upload_any, the_next_generation_is_given_to_the_next_upload_when_one_fails) {
  d.take(upload_ended{upload_verdict::unchanged, {}, "no space"});
  d.upload({"Y"}, 1);
  EXPECT_EQ(d.s.plan->generation.number, 2U);
}

TEST(upload, after_a_restart_the_old_plan_id_means_that_the_upload_failed_without_reading_back) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.intend(map_of(px4, {"X"}, 1));
  d.crash();
  d.questions.clear();
  d.take(vehicle_looked_at{d.plan_id});
  EXPECT_TRUE(d.questions.empty());
  EXPECT_FALSE(d.s.upload);
  EXPECT_EQ(d.news_told().back(), "upload_failed g1");
  EXPECT_TRUE(d.is_armed());
}

TEST(upload, a_plan_with_the_same_content_has_the_old_id_and_is_read_back) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.intend(map_of(px4, {"A", "B"}), 2, assigned_key);
  d.crash();
  d.questions.clear();
  d.take(vehicle_looked_at{d.plan_id});
  ASSERT_EQ(d.questions.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<read_plan_back>(d.questions[0]));
  d.take(plan_read_back{read_back_match::pending});
  EXPECT_EQ(d.answers.at(0).response.outcome, mission::assignment_outcome::accepted);
  EXPECT_EQ(d.s.plan->generation.number, 2U);
}

TEST(upload, a_reached_that_waited_for_its_plan_counts_when_the_upload_failed) {
  progress_fixture d;
  d.fly({"A", "B"});
  d.intend(map_of(px4, {"X"}, 1), 2, assigned_key);
  d.reached(0);
  d.take(upload_ended{upload_verdict::unchanged, {}, "no space"});
  EXPECT_EQ(d.said(), (texts{"started A#0 g1", "reached A#0 g1"}));
  EXPECT_EQ(text_of(*d.answers.at(0).response.last_progress), "reached A#0 g1");
}

TEST(upload, what_was_held_survives_a_crash) {
  progress_fixture d;
  d.intend(map_of(px4, {"A"}));
  d.total = 1;
  auto of_new = d.current_message(0);
  of_new.mission_id = 101;
  d.say(of_new);
  d.crash();
  d.accept();
  EXPECT_TRUE(d.is_armed());
}

} // namespace upload_test
} // namespace godwit::executor::progress
