#include "programs/godwit-drill/flights/intervention_flight.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace intervention_flight_test {

using namespace godwit;
using namespace godwit::drill;

TEST(intervention_flight, has_no_flaw) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto outcome = fly_intervention(seed, std::nullopt, {});
    EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
    EXPECT_GT(outcome.flown_s, 10);
  }
}

TEST(intervention_flight, flies_the_same_again_from_its_seed) {
  const auto first = fly_intervention(11, std::nullopt, {.tells_story = true});
  const auto second = fly_intervention(11, std::nullopt, {.tells_story = true});
  EXPECT_EQ(first.story, second.story);
  EXPECT_EQ(first.deliveries, second.deliveries);
  EXPECT_NE(first.story, fly_intervention(12, std::nullopt, {.tells_story = true}).story);
}

TEST(intervention_flight, without_all_of_its_acts_nobody_is_in_the_way) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    std::vector<std::uint64_t> all(most_interventions + 1);
    std::iota(all.begin(), all.end(), 0);
    const auto outcome = fly_intervention(seed, std::nullopt, {}, all);
    EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
  }
}

TEST(intervention_flight, finds_an_order_to_a_vehicle_that_a_person_has) {
  constexpr std::uint64_t most_seeds = 60;
  const auto finds = [](std::uint64_t seed) {
    const auto outcome = fly_intervention(seed, std::nullopt, {.planted = planted_flaw::order_to_person});
    return std::ranges::any_of(
        outcome.flaws, [](const std::string& each) { return each.find("taken: MISSION_START") != std::string::npos; });
  };
  std::uint64_t seed = 1;
  while (seed < most_seeds && !finds(seed))
    ++seed;
  EXPECT_LT(seed, most_seeds);
}

} // namespace intervention_flight_test
