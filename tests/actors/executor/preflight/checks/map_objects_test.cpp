#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace map_objects_test {

using namespace test;

using mission_client::pull_state;

result with(pull_state map, std::string problem = {}) {
  auto seen = good_facts();
  seen.mission.map = map;
  seen.mission.map_problem = std::move(problem);
  return check_map_objects(seen, {});
}

TEST(map_objects_check, passes_when_they_are_pulled) { EXPECT_EQ(with(pull_state::synced).how, verdict::pass); }

TEST(map_objects_check, degrades_with_a_copy_from_before_and_says_the_same_whatever_the_cause) {
  EXPECT_EQ(with(pull_state::cached_fallback).how, verdict::degraded);
  EXPECT_EQ(with(pull_state::cached_fallback, "503"), with(pull_state::cached_fallback, "no answer"));
}

TEST(map_objects_check, fails_when_they_are_not_pulled_yet) {
  EXPECT_EQ(with(pull_state::not_started).how, verdict::fail);
  EXPECT_EQ(with(pull_state::in_flight), fail("The objects of the map are being pulled; wait."));
}

TEST(map_objects_check, fails_when_the_pull_failed_without_a_copy_and_says_why) {
  const auto found = with(pull_state::failed, "After 5 tries: no answer.");
  EXPECT_EQ(found.how, verdict::fail);
  EXPECT_TRUE(has(found.sentence, "After 5 tries: no answer.")) << found.sentence;
}

TEST(map_objects_check, is_skipped_for_a_mission_that_has_no_service) {
  auto seen = good_facts();
  seen.mission.has_service = false;
  seen.mission.map = pull_state::not_started;
  EXPECT_EQ(check_map_objects(seen, {}).how, verdict::skipped);
}

} // namespace map_objects_test
} // namespace godwit::executor::preflight
