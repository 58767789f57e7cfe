#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace places_test {

using namespace test;

TEST(places_check, passes_when_all_places_are_within_the_limits) {
  EXPECT_EQ(check_places(good_facts(), {}).how, verdict::pass);
}

TEST(places_check, fails_and_names_the_place_that_is_not) {
  auto seen = good_facts();
  seen.mission.out_of_limits = {"Item 2 'east' is 16,600 km east of home.", "Item 3 is too."};
  const auto found = check_places(seen, {});
  EXPECT_EQ(found.how, verdict::fail);
  EXPECT_TRUE(has(found.sentence, "Item 2 'east' is 16,600 km east of home.")) << found.sentence;
}

TEST(places_check, fails_before_it_was_looked_at) {
  auto seen = good_facts();
  seen.mission.out_of_limits.reset();
  EXPECT_EQ(check_places(seen, {}).how, verdict::fail);
}

TEST(places_check, is_skipped_without_a_mission) {
  auto seen = good_facts();
  seen.mission.document = nullptr;
  EXPECT_EQ(check_places(seen, {}).how, verdict::skipped);
}

} // namespace places_test
} // namespace godwit::executor::preflight
