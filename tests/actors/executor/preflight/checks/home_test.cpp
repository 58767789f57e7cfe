#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace home_test {

using namespace test;

TEST(home_check, passes_when_the_vehicle_knows_its_home) { EXPECT_EQ(check_home(good_facts(), {}).how, verdict::pass); }

TEST(home_check, fails_when_it_does_not) {
  auto seen = good_facts();
  seen.vehicle.is_home_known = false;
  EXPECT_EQ(check_home(seen, {}).how, verdict::fail);
}

TEST(home_check, is_skipped_while_the_vehicle_is_not_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(check_home(seen, {}).how, verdict::skipped);
}

} // namespace home_test
} // namespace godwit::executor::preflight
