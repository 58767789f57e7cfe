#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace wall_clock_test {

using namespace test;

TEST(wall_clock_check, passes_from_the_configured_date_on) {
  auto seen = good_facts();
  seen.wall_ns = 2'000 * ns_per_s;
  EXPECT_EQ(check_wall_clock(seen, {.earliest_date_s = 2'000}).how, verdict::pass);
}

TEST(wall_clock_check, fails_before_it) {
  auto seen = good_facts();
  seen.wall_ns = 2'000 * ns_per_s - 1;
  EXPECT_EQ(check_wall_clock(seen, {.earliest_date_s = 2'000}).how, verdict::fail);
  seen.wall_ns = 0; // a computer without a clock of its own wakes up in 1970
  EXPECT_EQ(check_wall_clock(seen, {}).how, verdict::fail);
}

} // namespace wall_clock_test
} // namespace godwit::executor::preflight
