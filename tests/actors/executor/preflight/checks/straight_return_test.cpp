#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace straight_return_test {

using namespace test;

result with(std::vector<plan::return_crossing> found, bool is_asked = true) {
  auto seen = good_facts();
  seen.mission.straight_return = std::move(found);
  return check_straight_return(seen, {.asks_for_straight_return = is_asked});
}

TEST(straight_return_check, passes_where_no_return_crosses_a_fence) { EXPECT_EQ(with({}).how, verdict::pass); }

TEST(straight_return_check, names_the_fence_and_the_items_from_which_it_is_crossed) {
  const auto found = with({{1, 2}, {2, 2}, {2, 3}});
  EXPECT_EQ(found, degraded("The return of a failsafe is straight, and leads into geofence 3 from the way to item "
                            "'east', 'back'. Move these items or the fence, or acknowledge that it flies there."));
}

TEST(straight_return_check, passes_where_nobody_is_asked_and_says_the_same) {
  const auto found = with({{1, 2}, {2, 2}, {2, 3}}, false);
  EXPECT_EQ(found, pass("The return of a failsafe is straight, and leads into geofence 3 from the way to item 'east', "
                        "'back'."));
}

TEST(straight_return_check, of_many_items_it_names_the_first_ones) {
  auto mission = small_mission();
  std::vector<plan::return_crossing> all;
  for (std::uint32_t i = 0; i < 20; ++i) {
    mission.items.emplace_back(plan::waypoint("extra" + std::to_string(i), plan::at(100, i, 30)));
    all.push_back({i + 3, 0});
  }
  auto seen = good_facts();
  seen.mission.document = &mission;
  seen.mission.straight_return = all;
  const auto found = check_straight_return(seen, {});
  EXPECT_TRUE(has(found.sentence, "'extra7' and 12 more.")) << found.sentence;
}

TEST(straight_return_check, fails_before_it_was_looked_at_and_is_skipped_without_fences) {
  auto seen = good_facts();
  seen.mission.straight_return.reset();
  EXPECT_EQ(check_straight_return(seen, {}).how, verdict::fail);
  auto mission = small_mission();
  mission.geofences.clear();
  seen.mission.document = &mission;
  EXPECT_EQ(check_straight_return(seen, {}).how, verdict::skipped);
}

} // namespace straight_return_test
} // namespace godwit::executor::preflight
