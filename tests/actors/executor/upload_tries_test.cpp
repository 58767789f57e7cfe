#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/executor/tasks/upload_tries.hpp"
#include "tests/actors/executor/flight_world.hpp"

namespace godwit::executor {
namespace upload_tries_test {

namespace transfer = vehicle_link::transfer;
using progress::upload_verdict;
using tests::flight_world;

constexpr std::int64_t second = 1'000'000'000;

transfer::outcome outcome_of(transfer::verdict verdict, transfer::holding holding) {
  transfer::outcome result;
  result.verdict = verdict;
  result.holding = holding;
  return result;
}

const auto unheard = outcome_of(transfer::verdict::timed_out, transfer::holding::unknown);
const auto not_begun = outcome_of(transfer::verdict::not_begun, transfer::holding::unchanged);
const auto refused = outcome_of(transfer::verdict::refused, transfer::holding::unchanged);

TEST(upload_tries, without_an_answer_the_plan_goes_up_again_three_times_at_most) {
  upload_tries tries;
  tries.begin(0);
  EXPECT_TRUE(tries.go_on(unheard, second));
  EXPECT_TRUE(tries.go_on(unheard, 2 * second));
  EXPECT_FALSE(tries.go_on(unheard, 3 * second));
}

TEST(upload_tries, a_try_that_was_not_begun_costs_only_time) {
  upload_tries tries;
  tries.begin(0);
  for (std::int64_t at = 1; at < 30; ++at)
    EXPECT_TRUE(tries.go_on(not_begun, at * second)) << at;
  EXPECT_FALSE(tries.go_on(not_begun, 30 * second));
}

TEST(upload_tries, what_the_vehicle_refuses_is_not_brought_again) {
  upload_tries tries;
  tries.begin(0);
  EXPECT_FALSE(tries.go_on(refused, second));
  EXPECT_EQ(tries.end(refused).verdict, upload_verdict::unchanged);
}

TEST(upload_tries, after_a_try_that_may_have_come_through_the_vehicle_is_looked_at) {
  upload_tries tries;
  tries.begin(0);
  ASSERT_TRUE(tries.go_on(unheard, second));
  EXPECT_EQ(tries.end(refused).verdict, upload_verdict::unknown);
  EXPECT_EQ(tries.end(not_begun).verdict, upload_verdict::unknown);
  EXPECT_EQ(tries.end_unsent("it was given up").verdict, upload_verdict::unknown);
  EXPECT_EQ(tries.end(outcome_of(transfer::verdict::accepted, transfer::holding::this_plan)).verdict,
            upload_verdict::accepted);
  tries.begin(2 * second); // another plan
  EXPECT_EQ(tries.end_unsent("it was given up").verdict, upload_verdict::unchanged);
}

RC_GTEST_PROP(upload_tries_property, come_to_an_end_whatever_is_answered, ()) {
  upload_tries tries;
  tries.begin(0);
  const auto kinds = *rc::gen::container<std::vector<int>>(40, rc::gen::inRange(0, 4));
  int begun = 0;
  int asked = 0;
  for (const auto kind : kinds) {
    ++asked;
    const auto outcome = kind == 0 ? refused : kind == 1 ? unheard : not_begun;
    begun += kind <= 1 ? 1 : 0;
    if (!tries.go_on(outcome, asked * second))
      break;
  }
  RC_ASSERT(asked <= 30);
  RC_ASSERT(begun <= max_uploads);
}

// -- on a flight ------------------------------------------------------------------------------------

mission::assignment other_tail(const mission::document& mission, sim::personality who) {
  mission::assignment assignment{"5c3f1c84-92f1-4b7f-8a35-3e0fd1a1f3e7", 1, 2, "w2", {}};
  const double up_m = who == sim::personality::rover ? 0 : 20;
  assignment.items = {tests::place("n1", 20, 20, up_m), tests::place("n2", -30, 20, up_m), mission.items.back()};
  return assignment;
}

class every_upload : public testing::TestWithParam<sim::personality> {};

// The slow line lets the link die at each step of the transfer: announced, under way, all sent, and acknowledged.
TEST_P(every_upload, of_an_assignment_is_tried_again_when_the_link_dies_in_it_and_answered_once) {
  for (int moment = 0; moment < 40; ++moment) {
    flight_world world({.who = GetParam(), .most_delay_ms = 60});
    const auto mission = tests::short_mission(GetParam());
    world.load(mission);
    ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
    world.assign(other_tail(mission, GetParam()));
    ASSERT_TRUE(world.run_until([&] { return world.durable().progress.upload.has_value(); }, 60)) << world.story();
    world.run_for(0.02 * moment);
    world.crash_link();
    ASSERT_TRUE(world.run_until([&] { return !world.answers().empty(); }, 60)) << moment << world.story();
    EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::accepted)
        << moment << world.story();
    ASSERT_TRUE(world.run_until_phase(phase::done)) << moment << world.story();
    EXPECT_EQ(world.answers().size(), 1U) << moment << world.story();
    EXPECT_EQ(world.reports().back().kind, mission::progress_kind::complete) << moment << world.story();
    EXPECT_EQ(world.durable().mission->revision, 2) << moment << world.story();
  }
}

TEST_P(every_upload, on_the_ground_is_tried_again_when_the_link_dies_in_it) {
  flight_world world({.who = GetParam(), .most_delay_ms = 60});
  world.load(tests::short_mission(GetParam()));
  ASSERT_TRUE(world.run_until([&] { return world.durable().progress.upload.has_value(); }, 120)) << world.story();
  world.run_for(0.1);
  world.crash_link();
  ASSERT_TRUE(world.run_until([&] { return world.durable().status.now == phase::flying; }, 120)) << world.story();
  ASSERT_TRUE(world.run_until_phase(phase::done)) << world.story();
}

// What has gone out before the link died may come through all the same; then the answer says that.
TEST_P(every_upload, that_dies_with_its_link_each_time_is_answered_once_as_the_vehicle_holds_it) {
  flight_world world({.who = GetParam(), .most_delay_ms = 60});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  world.assign(other_tail(mission, GetParam()));
  int deaths = 0;
  const auto is_answered = [&] {
    if (world.is_uploading() && deaths < max_uploads) {
      world.crash_link();
      ++deaths;
    }
    return !world.answers().empty();
  };
  ASSERT_TRUE(world.run_until(is_answered, 120)) << world.story();
  EXPECT_EQ(deaths, max_uploads) << world.story();
  const bool is_accepted = world.answers().front().response.outcome == mission::assignment_outcome::accepted;
  EXPECT_EQ(world.durable().flown->mission.revision, is_accepted ? 2 : 1) << world.story();
  world.run_for(60);
  EXPECT_EQ(world.answers().size(), 1U) << world.story();
}

TEST_P(every_upload, whose_link_has_died_and_that_is_given_up_by_a_word_is_answered_once_and_a_resume_goes_on) {
  for (int moment = 0; moment < 20; ++moment) {
    flight_world world({.who = GetParam(), .most_delay_ms = 60});
    const auto mission = tests::short_mission(GetParam());
    world.load(mission);
    ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
    world.assign(other_tail(mission, GetParam()));
    ASSERT_TRUE(world.run_until([&] { return world.is_uploading(); }, 60)) << world.story();
    world.run_for(0.04 * moment);
    world.crash_link();
    world.run_for(0.5); // before it is tried again
    ASSERT_TRUE(world.say(operators::command_kind::pause).is_taken) << world.story();
    ASSERT_TRUE(world.run_until_phase(phase::paused, 60)) << moment << world.story();
    world.run_for(10);
    EXPECT_EQ(world.answers().size(), 1U) << moment << world.story();
    ASSERT_TRUE(world.say(operators::command_kind::resume).is_taken) << moment << world.story();
    ASSERT_TRUE(world.run_until_phase(phase::done)) << moment << world.story();
    EXPECT_EQ(world.reports().back().kind, mission::progress_kind::complete) << moment << world.story();
  }
}

// A person goes on with what is held, or has items of both plans.
bool is_answered(flight_world& world) {
  const auto& at = world.durable().status;
  if (at.now == phase::paused && !needs_hand_back(at.cause))
    static_cast<void>(world.say(operators::command_kind::resume));
  return !world.answers().empty();
}

// Of the executor, or of the process: what came to the vehicle counts, and else it is brought again. On a line on which
// frames overtake each other a copy of an earlier mode order may come after the hold: that is taken for a person's.
TEST_P(every_upload, of_an_assignment_that_is_cut_off_by_a_crash_is_tried_again_and_answered_once) {
  for (const bool is_process : {false, true})
    for (int moment = 0; moment < 60; ++moment) {
      flight_world world({.who = GetParam(), .speed = 2, .most_delay_ms = 60, .keeps_order = true});
      const auto mission = tests::short_mission(GetParam());
      world.load(mission);
      ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
      world.assign(other_tail(mission, GetParam()));
      ASSERT_TRUE(world.run_until([&] { return world.durable().progress.upload.has_value(); }, 60)) << world.story();
      world.run_for(0.01 * moment);
      if (!world.durable().progress.upload) { // it is not cut off any more
        EXPECT_GE(moment, 8);
        break;
      }
      if (is_process)
        world.crash_all();
      else
        world.crash();
      ASSERT_TRUE(world.run_until([&] { return is_answered(world); }, 120))
          << is_process << " " << moment << world.story();
      EXPECT_EQ(world.answers().front().response.outcome, mission::assignment_outcome::accepted)
          << is_process << " " << moment << world.story();
      const auto is_done = [&] { return is_answered(world) && world.durable().status.now == phase::done; };
      ASSERT_TRUE(world.run_until(is_done, 600)) << is_process << " " << moment << world.story();
      EXPECT_EQ(world.answers().size(), 1U) << moment << world.story();
      EXPECT_EQ(world.durable().mission->revision, 2) << moment << world.story();
    }
}

TEST_P(every_upload, of_an_assignment_that_kills_godwit_each_time_is_answered_in_the_end) {
  flight_world world({.who = GetParam(), .speed = 2, .most_delay_ms = 60});
  const auto mission = tests::short_mission(GetParam());
  world.load(mission);
  ASSERT_TRUE(world.run_until([&] { return world.reports().size() >= 3; }, 600)) << world.story();
  world.assign(other_tail(mission, GetParam()));
  int deaths = 0;
  const auto dies_until_answered = [&] {
    if (world.is_uploading() && world.durable().progress.upload && deaths < 10) {
      world.crash_all();
      ++deaths;
    }
    return is_answered(world);
  };
  ASSERT_TRUE(world.run_until(dies_until_answered, 300)) << world.story();
  world.run_for(60);
  EXPECT_EQ(world.answers().size(), 1U) << world.story();
}

INSTANTIATE_TEST_SUITE_P(vehicles, every_upload,
                         testing::Values(sim::personality::rover, sim::personality::px4, sim::personality::ardupilot),
                         [](const auto& who) { return std::string(io::name_of(who.param)); });

} // namespace upload_tries_test
} // namespace godwit::executor
