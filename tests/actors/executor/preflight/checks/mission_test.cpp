#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace mission_test {

using namespace test;

TEST(mission_check, passes_when_it_is_loaded_and_can_be_said_to_the_vehicle) {
  EXPECT_EQ(check_mission(good_facts(), {}), pass("The mission is loaded and can be flown (items: 3, plans: 1)."));
}

TEST(mission_check, fails_without_one_and_says_why) {
  auto seen = good_facts();
  seen.mission.document = nullptr;
  EXPECT_EQ(check_mission(seen, {}).how, verdict::fail);
  seen.mission.refusal = "the service does not know it";
  EXPECT_EQ(check_mission(seen, {}), fail("No mission is loaded: the service does not know it"));
}

TEST(mission_check, fails_before_it_is_planned) {
  auto seen = good_facts();
  seen.mission.plans = nullptr;
  EXPECT_EQ(check_mission(seen, {}).how, verdict::fail);
}

TEST(mission_check, fails_when_the_vehicle_can_not_fly_it_and_names_the_item) {
  const auto grounded = plan::mission_of({plan::waypoint("east", plan::at(100, 0, 30))});
  const plan_result plans = plan::build_plans(grounded, plan::px4_copter);
  ASSERT_FALSE(plans);
  auto seen = good_facts();
  seen.mission.document = &grounded;
  seen.mission.plans = &plans;
  const auto found = check_mission(seen, {});
  EXPECT_EQ(found.how, verdict::fail);
  EXPECT_TRUE(has(found.sentence, plans.error().message())) << found.sentence;
}

TEST(mission_check, fails_when_there_is_nothing_to_fly) {
  const plan_result none = std::vector<plan::flight_plan>{};
  auto seen = good_facts();
  seen.mission.plans = &none;
  EXPECT_EQ(check_mission(seen, {}).how, verdict::fail);
}

} // namespace mission_test
} // namespace godwit::executor::preflight
