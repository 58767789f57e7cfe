#include "programs/godwit-drill/flights/case_runner.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <map>

namespace case_runner_test {

using namespace godwit::drill;

std::map<std::size_t, flight_outcome> run(std::size_t count, case_runner_options options,
                                          const std::function<flight_outcome(std::size_t)>& fly) {
  std::map<std::size_t, flight_outcome> result;
  run_cases(count, options, fly,
            [&](std::size_t index, flight_outcome outcome) { EXPECT_TRUE(result.emplace(index, outcome).second); });
  return result;
}

flight_outcome good(std::size_t index) {
  flight_outcome result;
  result.name = "case " + std::to_string(index);
  result.commits = index;
  return result;
}

TEST(case_runner, gives_each_case_its_outcome_once) {
  for (const unsigned jobs : {1U, 3U, 50U}) {
    const auto outcomes = run(20, {.jobs = jobs}, good);
    ASSERT_EQ(outcomes.size(), 20U);
    for (const auto& [index, outcome] : outcomes) {
      EXPECT_EQ(outcome.name, "case " + std::to_string(index));
      EXPECT_EQ(outcome.commits, index);
    }
  }
}

TEST(case_runner, without_a_case_does_nothing) { EXPECT_TRUE(run(0, {.jobs = 2}, good).empty()); }

TEST(case_runner, carries_a_story_that_is_longer_than_a_pipe) {
  const std::string story(1'000'000, 'x');
  const auto outcomes = run(3, {.jobs = 2}, [&](std::size_t index) {
    auto result = good(index);
    result.story = story;
    return result;
  });
  for (const auto& [index, outcome] : outcomes)
    EXPECT_EQ(outcome.story, story) << index;
}

TEST(case_runner, a_case_that_ends_its_process_is_its_own_finding_and_the_others_are_flown) {
  const auto outcomes = run(10, {.jobs = 2}, [](std::size_t index) {
    if (index == 3)
      ::_exit(9);
    if (index == 5)
      (void)std::raise(SIGKILL);
    return good(index);
  });
  ASSERT_EQ(outcomes.size(), 10U);
  for (const auto& [index, outcome] : outcomes)
    EXPECT_EQ(outcome.held(), index != 3 && index != 5) << index;
  EXPECT_NE(outcomes.at(3).flaws.front().find("by itself with 9"), std::string::npos) << outcomes.at(3).flaws.front();
  EXPECT_NE(outcomes.at(5).flaws.front().find("signal 9"), std::string::npos) << outcomes.at(5).flaws.front();
}

TEST(case_runner, a_case_without_an_end_is_ended_and_the_others_are_flown) {
  const auto outcomes = run(4, {.jobs = 1, .most = std::chrono::milliseconds(50)}, [](std::size_t index) {
    while (index == 1)
      ::pause();
    return good(index);
  });
  ASSERT_EQ(outcomes.size(), 4U);
  for (const auto& [index, outcome] : outcomes)
    EXPECT_EQ(outcome.held(), index != 1) << index;
  EXPECT_NE(outcomes.at(1).flaws.front().find("no end"), std::string::npos);
}

} // namespace case_runner_test
