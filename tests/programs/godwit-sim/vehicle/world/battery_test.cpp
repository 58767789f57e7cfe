#include "programs/godwit-sim/vehicle/world/battery.hpp"

#include <gtest/gtest.h>

namespace godwit::sim::test {
namespace battery_test {

constexpr std::int64_t second_ns = 1'000'000'000;

TEST(sim_battery, a_full_one_lasts_its_endurance_in_flight) {
  battery full(100, 1'500);
  full.advance(0, 1);
  full.advance(750 * second_ns, 1);
  EXPECT_NEAR(full.percent(), 50, 1e-9);
  full.advance(1'499 * second_ns, 1);
  EXPECT_GT(full.percent(), 0);
  full.advance(1'501 * second_ns, 1);
  EXPECT_EQ(full.percent(), 0);
  EXPECT_NEAR(full.consumed_mah(), battery::capacity_mah, 1e-6);
}

TEST(sim_battery, at_rest_it_hardly_drains) {
  battery full(100, 1'500);
  full.advance(0, battery::idle_load);
  full.advance(1'500 * second_ns, battery::idle_load);
  EXPECT_NEAR(full.percent(), 98, 1e-9);
}

TEST(sim_battery, how_often_it_is_asked_makes_no_difference) {
  battery often(80, 1'000);
  battery once(80, 1'000);
  often.advance(0, 0.5);
  once.advance(0, 0.5);
  for (int i = 1; i <= 1'000; ++i)
    often.advance(i * second_ns / 10, 0.5);
  once.advance(100 * second_ns, 0.5);
  EXPECT_NEAR(often.percent(), once.percent(), 1e-9);
  EXPECT_NEAR(once.percent(), 75, 1e-9);
}

TEST(sim_battery, the_voltage_falls_with_charge_and_load) {
  battery one(100, 1'500);
  one.advance(0, 0);
  EXPECT_NEAR(one.voltage_v(), 16.8, 1e-9);
  double last_v = one.voltage_v() + 1;
  for (int percent = 100; percent >= 0; --percent) {
    one.set_percent(percent);
    EXPECT_LT(one.voltage_v(), last_v) << percent << " %";
    last_v = one.voltage_v();
  }
  EXPECT_NEAR(one.voltage_v(), 13.2, 1e-9);
  const double at_rest_v = one.voltage_v();
  one.advance(0, 1);
  EXPECT_LT(one.voltage_v(), at_rest_v);
  EXPECT_NEAR(one.current_a(), 12, 1e-9);
}

TEST(sim_battery, its_charge_can_be_set_within_0_and_100) {
  battery one(50, 1'500);
  for (const auto& [wanted, got] : {std::pair{15.0, 15.0}, {-3.0, 0.0}, {120.0, 100.0}}) {
    one.set_percent(wanted);
    EXPECT_EQ(one.percent(), got);
  }
}

TEST(sim_battery, the_first_call_sets_the_clock_and_time_does_not_go_back) {
  battery one(50, 100);
  one.advance(1'000 * second_ns, 1);
  EXPECT_EQ(one.percent(), 50);
  one.advance(999 * second_ns, 1);
  one.advance(1'001 * second_ns, 1);
  EXPECT_NEAR(one.percent(), 49, 1e-9);
}

} // namespace battery_test
} // namespace godwit::sim::test
