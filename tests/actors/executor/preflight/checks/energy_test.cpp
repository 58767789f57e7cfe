#include "actors/executor/preflight/checks/energy.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace {

using namespace test;

result with(std::optional<double> spare_percent) {
  auto seen = good_facts();
  seen.mission.spare_percent = spare_percent;
  return look_at_energy(seen, {});
}

TEST(energy_check, passes_when_the_battery_lasts_for_the_plan_and_the_way_home) {
  EXPECT_EQ(with(0).how, verdict::pass);
  EXPECT_EQ(with(40).how, verdict::pass);
}

TEST(energy_check, degrades_when_it_does_not) { EXPECT_EQ(with(-0.1).how, verdict::degraded); }

// An operator acknowledges the sentence, and would never get hold of one that is another each second.
TEST(energy_check, says_the_same_whatever_is_missing) { EXPECT_EQ(with(-1), with(-30)); }

TEST(energy_check, is_skipped_where_the_drain_is_not_known) { EXPECT_EQ(with({}).how, verdict::skipped); }

TEST(energy_check, is_skipped_while_the_vehicle_is_not_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(look_at_energy(seen, {}).how, verdict::skipped);
}

} // namespace
} // namespace godwit::executor::preflight
