#include "programs/godwit-sim/vehicle/autopilot/world_clock.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::sim {
namespace world_clock_test {

TEST(world_clock, runs_speed_times_as_fast) {
  const world_clock clock(20, 5 * ns_per_s);
  EXPECT_EQ(clock.world_ns(5 * ns_per_s), 0);
  EXPECT_EQ(clock.world_ns(6 * ns_per_s), 20 * ns_per_s);
  EXPECT_EQ(clock.at(6 * ns_per_s).real_ns, 6 * ns_per_s);
}

TEST(world_clock, knows_that_never_is_never) { EXPECT_EQ(world_clock(0.5, 7).real_ns(never_ns), never_ns); }

RC_GTEST_PROP(world_clock, the_time_outside_is_never_too_early_and_at_most_a_moment_late, ()) {
  const auto speed = *rc::gen::element(0.25, 1.0, 3.0, 7.7, 20.0, 100.0);
  const auto begin = *rc::gen::inRange<std::int64_t>(0, 2'000'000'000 * ns_per_s);
  const auto world = *rc::gen::inRange<std::int64_t>(0, 1'000'000 * ns_per_s);
  const world_clock clock(speed, begin);
  const auto real = clock.real_ns(world);
  RC_ASSERT(clock.world_ns(real) >= world);
  RC_ASSERT(clock.world_ns(real - 2) <= world);
}

} // namespace world_clock_test
} // namespace godwit::sim
