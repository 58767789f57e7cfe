#include "actors/executor/preflight/checks.hpp"

#include <gtest/gtest.h>

#include "tests/actors/executor/preflight/good_facts.hpp"

namespace godwit::executor::preflight {
namespace energy_test {

using namespace test;

result with(std::optional<double> spare_percent) {
  auto seen = good_facts();
  seen.mission.spare_percent = spare_percent;
  return check_energy(seen, {});
}

TEST(energy_check, passes_when_the_battery_lasts_for_the_plan_and_the_way_home) {
  EXPECT_EQ(with(0).how, verdict::pass);
  EXPECT_EQ(with(40).how, verdict::pass);
}

TEST(energy_check, degrades_when_it_does_not) { EXPECT_EQ(with(-0.1).how, verdict::degraded); }

// Where nobody is there to acknowledge, only what would end in a landing on the way is kept on the ground.
TEST(energy_check, asks_where_flights_begin_by_themselves_only_when_the_battery_ends_below_critical) {
  auto seen = good_facts();
  settings set;
  set.starts_by_itself = true;
  for (const auto& [spare, how] : {std::pair(5.0, verdict::pass), std::pair(-1.0, verdict::pass),
                                   std::pair(-10.0, verdict::pass), std::pair(-10.1, verdict::degraded)}) {
    seen.mission.spare_percent = spare;
    EXPECT_EQ(check_energy(seen, set).how, how) << spare;
  }
}

// An operator acknowledges the sentence, and would never get hold of one that is another each second.
TEST(energy_check, says_the_same_whatever_is_missing) { EXPECT_EQ(with(-1), with(-30)); }

TEST(energy_check, is_skipped_where_the_drain_is_not_known) { EXPECT_EQ(with({}).how, verdict::skipped); }

TEST(energy_check, is_skipped_while_the_vehicle_is_not_heard) {
  auto seen = good_facts();
  seen.vehicle.link = vehicle_link::connection_phase::lost;
  EXPECT_EQ(check_energy(seen, {}).how, verdict::skipped);
}

} // namespace energy_test
} // namespace godwit::executor::preflight
