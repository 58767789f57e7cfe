#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace planned_home_test {

using namespace test;

result look(double away_m) {
  auto seen = good_facts();
  seen.mission.planned_home = planned_home_fact{away_m, 45};
  return check_planned_home(seen, {});
}

TEST(planned_home_check, from_100_m_on_somebody_has_to_acknowledge_it) {
  EXPECT_EQ(look(99.9).how, verdict::pass);
  EXPECT_EQ(look(100).how, verdict::degraded);
}

TEST(planned_home_check, names_the_distance_and_that_nobody_flies_there) {
  EXPECT_EQ(look(352).sentence,
            "The planned home of the mission is 350 m north-east of the vehicle's home. Nothing flies there: returns "
            "lead to the vehicle's home. Check that the mission is for this place.");
  EXPECT_EQ(look(12).sentence, "The planned home of the mission is 12 m from the vehicle's home.");
}

TEST(planned_home_check, fails_before_it_was_looked_at) {
  auto seen = good_facts();
  seen.mission.planned_home.reset();
  EXPECT_EQ(check_planned_home(seen, {}).how, verdict::fail);
}

TEST(planned_home_check, is_skipped_without_one) {
  auto seen = good_facts();
  auto mission = small_mission();
  mission.planned_home.reset();
  seen.mission.document = &mission;
  EXPECT_EQ(check_planned_home(seen, {}).how, verdict::skipped);
  seen.mission.document = nullptr;
  EXPECT_EQ(check_planned_home(seen, {}).how, verdict::skipped);
}

} // namespace planned_home_test
} // namespace godwit::executor::preflight
