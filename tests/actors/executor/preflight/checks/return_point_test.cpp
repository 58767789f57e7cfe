#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace return_point_test {

using namespace test;

result with(const mission::document& mission) {
  auto seen = good_facts();
  seen.mission.document = &mission;
  seen.mission.return_point = plan::return_point_violations(mission);
  return check_return_point(seen, {});
}

TEST(return_point_check, passes_inside_of_the_inclusion_and_outside_of_the_exclusion) {
  auto mission = small_mission();
  mission.geofences.push_back(tests::exclusion(tests::box(20, 20, 30, 30)));
  EXPECT_EQ(with(mission).how, verdict::pass);
}

TEST(return_point_check, fails_outside_of_the_inclusion) {
  auto mission = small_mission();
  mission.return_point = plan::at(0, 500, 0);
  const auto found = with(mission);
  EXPECT_EQ(found.how, verdict::fail);
  EXPECT_TRUE(has(found.sentence, "The return point")) << found.sentence;
}

TEST(return_point_check, fails_inside_of_an_exclusion) {
  auto mission = small_mission();
  mission.geofences.push_back(tests::exclusion(tests::box(-10, -10, 10, 10)));
  EXPECT_EQ(with(mission).how, verdict::fail);
}

TEST(return_point_check, fails_before_it_was_looked_at) {
  auto seen = good_facts();
  seen.mission.return_point.reset();
  EXPECT_EQ(check_return_point(seen, {}).how, verdict::fail);
}

TEST(return_point_check, is_skipped_without_fences) {
  auto mission = small_mission();
  mission.geofences.clear();
  EXPECT_EQ(with(mission).how, verdict::skipped);
}

TEST(return_point_check, is_skipped_without_a_mission) {
  auto seen = good_facts();
  seen.mission.document = nullptr;
  EXPECT_EQ(check_return_point(seen, {}).how, verdict::skipped);
}

} // namespace return_point_test
} // namespace godwit::executor::preflight
