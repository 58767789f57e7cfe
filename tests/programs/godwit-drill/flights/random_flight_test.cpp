#include "programs/godwit-drill/flights/random_flight.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace random_flight_test {

using namespace godwit;
using namespace godwit::drill;

// The first seed at which a flight that does this wrong is found out; 0: none of the first.
std::uint64_t found_at(planted_flaw planted, const std::string& words) {
  constexpr std::uint64_t most_seeds = 60;
  for (std::uint64_t seed = 1; seed <= most_seeds; ++seed)
    for (const auto& flaw : fly_random(seed, std::nullopt, {.planted = planted}).flaws)
      if (flaw.find(words) != std::string::npos)
        return seed;
  return 0;
}

TEST(random_flight, without_a_planted_flaw_has_none) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto outcome = fly_random(seed, std::nullopt, {});
    EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
    EXPECT_TRUE(outcome.story.empty()) << "told when it is of use";
    EXPECT_GT(outcome.deliveries, 1'000U);
    EXPECT_GT(outcome.flown_s, 10);
  }
}

TEST(random_flight, flies_the_same_again_from_its_seed) {
  const auto first = fly_random(11, std::nullopt, {.tells_story = true});
  const auto second = fly_random(11, std::nullopt, {.tells_story = true});
  EXPECT_EQ(first.story, second.story);
  EXPECT_EQ(first.deliveries, second.deliveries);
  EXPECT_NE(first.story, fly_random(12, std::nullopt, {.tells_story = true}).story);
}

TEST(random_flight, without_all_of_its_faults_is_undisturbed) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    std::vector<std::uint64_t> all(most_faults);
    std::iota(all.begin(), all.end(), 0);
    const auto outcome = fly_random(seed, std::nullopt, {}, all);
    EXPECT_TRUE(outcome.held()) << outcome.flaws.front();
    EXPECT_EQ(outcome.kills + outcome.crashes + outcome.takeovers, 0U) << seed;
    EXPECT_LE(outcome.faults, most_faults);
  }
}

TEST(random_flight, finds_a_report_that_is_lost) {
  EXPECT_EQ(found_at(planted_flaw::lose_report, "stands where 3 should"), 1U);
  EXPECT_GT(fly_random(1, std::nullopt, {.planted = planted_flaw::lose_report}).lost, 0U);
}

TEST(random_flight, finds_a_report_that_is_doubled) {
  EXPECT_EQ(found_at(planted_flaw::double_report, "report 3 stands where"), 1U);
  EXPECT_GT(fly_random(1, std::nullopt, {.planted = planted_flaw::double_report}).doubled, 0U);
}

TEST(random_flight, finds_an_order_to_a_vehicle_that_a_person_has) {
  EXPECT_NE(found_at(planted_flaw::order_to_person, "after a takeover"), 0U);
}

TEST(random_flight, finds_in_the_record_what_the_service_does_not_see) {
  EXPECT_NE(found_at(planted_flaw::forget_delivery, "reports_without_gap"), 0U);
}

} // namespace random_flight_test
