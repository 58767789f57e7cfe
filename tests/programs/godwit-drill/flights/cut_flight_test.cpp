#include "programs/godwit-drill/flights/cut_flight.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace cut_flight_test {

using namespace godwit;
using namespace godwit::drill;

TEST(cut_flight, has_no_flaw) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto outcome = fly_cut(seed, std::nullopt, {});
    EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
  }
}

TEST(cut_flight, flies_the_same_again_from_its_seed) {
  const auto first = fly_cut(11, std::nullopt, {.tells_story = true});
  const auto second = fly_cut(11, std::nullopt, {.tells_story = true});
  EXPECT_EQ(first.story, second.story);
  EXPECT_NE(first.story, fly_cut(12, std::nullopt, {.tells_story = true}).story);
}

TEST(cut_flight, without_all_of_its_cuts_nothing_is_in_the_way) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    std::vector<std::uint64_t> all(most_cuts + 1);
    std::iota(all.begin(), all.end(), 0);
    const auto outcome = fly_cut(seed, std::nullopt, {}, all);
    EXPECT_TRUE(outcome.held()) << outcome.flaws.front() << '\n' << outcome.story;
    EXPECT_EQ(outcome.takeovers + outcome.kills + outcome.crashes, 0U);
  }
}

TEST(cut_flight, finds_an_order_to_a_vehicle_that_a_person_has) {
  constexpr std::uint64_t most_seeds = 60;
  const auto finds = [](std::uint64_t seed) {
    const auto outcome = fly_cut(seed, std::nullopt, {.planted = planted_flaw::order_to_person});
    return std::ranges::any_of(
        outcome.flaws, [](const std::string& each) { return each.find("taken: MISSION_START") != std::string::npos; });
  };
  std::uint64_t seed = 1;
  while (seed < most_seeds && !finds(seed))
    ++seed;
  EXPECT_LT(seed, most_seeds);
}

} // namespace cut_flight_test
