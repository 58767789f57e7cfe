#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace fences_test {

using namespace test;

mission::document mission_within(mission::geofence fence) {
  auto result = small_mission();
  result.geofences = {std::move(fence)};
  return result;
}

// As the executor compares a mission that it has planned.
result with(const mission::document& mission) {
  const plan_result plans = plan::build_plans(mission, plan::px4_copter);
  auto seen = good_facts();
  seen.mission.document = &mission;
  seen.mission.plans = &plans;
  seen.mission.way.emplace();
  for (const auto& each : *plans)
    for (auto& found : plan::fence_violations(each, mission, flight::vehicle_class::multirotor))
      seen.mission.way->push_back(std::move(found));
  return check_fences(seen, {});
}

TEST(fences_check, passes_when_the_way_keeps_to_the_fences) { EXPECT_EQ(with(small_mission()).how, verdict::pass); }

TEST(fences_check, fails_when_the_way_leaves_an_inclusion_and_names_the_item) {
  const auto found = with(mission_within(tests::inclusion(tests::box(-50, -50, 90, 50))));
  EXPECT_EQ(found, fail("The mission does not keep to its fences; change it or them. The way to item 'east' leaves "
                        "geofence 1, which it has to stay in. (and 1 more)"));
}

TEST(fences_check, fails_when_a_leg_crosses_an_exclusion_though_its_ends_are_outside) {
  const auto found = with(mission_within(tests::exclusion(tests::box(40, -10, 60, 10))));
  EXPECT_EQ(found.how, verdict::fail);
  EXPECT_TRUE(has(found.sentence, "comes into geofence 1")) << found.sentence;
}

// As the vehicle judges it, which asks nobody: an operator sees that the fence may not be what was meant.
TEST(fences_check, is_degraded_when_a_fence_crosses_itself_and_the_way_keeps_to_it) {
  auto fence = tests::inclusion(tests::box(-50, -50, 200, 200));
  const auto first = fence.vertices.front();
  fence.vertices.insert(
      fence.vertices.end(),
      {first, {first.latitude - 0.01, first.longitude}, {first.latitude - 0.01, first.longitude - 0.01}});
  const auto found = with(mission_within(fence));
  EXPECT_EQ(found.how, verdict::degraded) << found.sentence;
  EXPECT_TRUE(has(found.sentence, "geofence 1 has corner 4 at the place of corner 0")) << found.sentence;
}

TEST(fences_check, fails_before_the_way_was_looked_at) {
  auto seen = good_facts();
  seen.mission.way.reset();
  EXPECT_EQ(check_fences(seen, {}).how, verdict::fail);
}

TEST(fences_check, is_skipped_without_fences) {
  auto mission = small_mission();
  mission.geofences.clear();
  EXPECT_EQ(with(mission).how, verdict::skipped);
}

TEST(fences_check, is_skipped_when_there_is_no_way_and_the_mission_fails_then) {
  auto unloaded = good_facts();
  unloaded.mission.document = nullptr;
  auto unplanned = good_facts();
  unplanned.mission.plans = nullptr;
  const plan_result refused = tl::unexpected(plan::plan_error{});
  auto impossible = good_facts();
  impossible.mission.plans = &refused;
  for (const auto& each : {unloaded, unplanned, impossible}) {
    EXPECT_EQ(check_fences(each, {}).how, verdict::skipped);
    EXPECT_EQ(check_mission(each, {}).how, verdict::fail);
  }
}

} // namespace fences_test
} // namespace godwit::executor::preflight
