#include <gtest/gtest.h>

#include "actors/failsafe/health.hpp"

namespace health_test {

using namespace godwit::failsafe;

findings all_well() {
  return {.flight = {.link_up = true, .in_flight = true, .may_act = true, .landed_known = true},
          .what = vehicle_class::multirotor,
          .battery = {.known = true, .percent = 80},
          .fences = fence_finding::inside,
          .link = link_phase::ok,
          .taken_over = false,
          .limits_refused = false,
          .reacts = {}};
}

TEST(health, when_all_is_known_and_nothing_acts_it_is_well_and_says_nothing) {
  EXPECT_EQ(judge_health(all_well()), (godwit::runtime::condition{godwit::runtime::health_colour::green, ""}));
}

TEST(health, an_unknown_battery_is_yellow) {
  auto all = all_well();
  all.battery = {};
  EXPECT_EQ(judge_health(all).how, godwit::runtime::health_colour::yellow);
}

TEST(health, a_position_that_is_too_old_is_yellow) {
  auto all = all_well();
  all.fences = fence_finding::no_verdict;
  EXPECT_EQ(judge_health(all).how, godwit::runtime::health_colour::yellow);
}

TEST(health, an_autopilot_that_is_not_heard_leaves_it_to_its_own_failsafes_and_says_so) {
  auto all = all_well();
  all.flight = {};
  EXPECT_EQ(judge_health(all).reason, "no connection to the autopilot: only its own failsafes act");
}

TEST(health, what_keeps_failsafes_from_acting_is_said) {
  auto all = all_well();
  all.what = vehicle_class::unknown;
  EXPECT_EQ(judge_health(all).how, godwit::runtime::health_colour::red);
  all = all_well();
  all.flight.landed_known = false;
  EXPECT_EQ(judge_health(all).how, godwit::runtime::health_colour::yellow);
  all = all_well();
  all.limits_refused = true;
  EXPECT_EQ(judge_health(all).how, godwit::runtime::health_colour::red);
}

TEST(health, a_silent_operator_a_breach_and_a_pilot_are_yellow) {
  auto silent = all_well();
  silent.link = link_phase::degraded;
  auto beyond = all_well();
  beyond.fences = fence_finding::breached;
  auto piloted = all_well();
  piloted.taken_over = true;
  for (const auto& each : {silent, beyond, piloted})
    EXPECT_EQ(judge_health(each).how, godwit::runtime::health_colour::yellow);
}

TEST(health, an_action_is_yellow_and_one_that_does_not_get_through_is_red) {
  auto all = all_well();
  all.reacts = told_reaction{};
  EXPECT_EQ(judge_health(all).how, godwit::runtime::health_colour::yellow);
  all.reacts->stage = reaction_stage::failing;
  EXPECT_EQ(judge_health(all).how, godwit::runtime::health_colour::red);
}

TEST(health, the_worst_gives_the_colour_and_all_sentences_are_there) {
  auto all = all_well();
  all.battery = {};
  all.limits_refused = true;
  const auto result = judge_health(all);
  EXPECT_EQ(result.how, godwit::runtime::health_colour::red);
  EXPECT_NE(result.reason.find("battery"), std::string::npos);
  EXPECT_NE(result.reason.find("; "), std::string::npos);
  EXPECT_NE(result.reason.find("refused"), std::string::npos);
}

} // namespace health_test
