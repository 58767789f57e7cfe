#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace actors_test {

using namespace test;

TEST(actors_check, passes_when_all_run) { EXPECT_EQ(check_actors(good_facts(), {}).how, verdict::pass); }

TEST(actors_check, fails_when_one_does_not_run_and_names_it) {
  auto seen = good_facts();
  seen.actors = {{"vehicle_link", true}, {"mission_client", false}, {"failsafe", false}};
  const auto found = check_actors(seen, {});
  EXPECT_EQ(found.how, verdict::fail);
  EXPECT_TRUE(has(found.sentence, ": mission_client, failsafe;")) << found.sentence;
}

TEST(actors_check, fails_when_nothing_is_known_of_them) {
  auto seen = good_facts();
  seen.actors.clear();
  EXPECT_EQ(check_actors(seen, {}).how, verdict::fail);
}

TEST(actors_check, fails_when_another_version_was_installed_meanwhile_which_a_crash_in_flight_would_start) {
  auto seen = good_facts();
  seen.program.is_exchanged = true;
  const auto found = check_actors(seen, {});
  EXPECT_EQ(found.how, verdict::fail);
  EXPECT_TRUE(has(found.sentence, "Start the program again.")) << found.sentence;
}

} // namespace actors_test
} // namespace godwit::executor::preflight
