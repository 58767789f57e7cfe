#include "actors/domain/energy/energy.hpp"
#include "tests/support/time_units.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace godwit::energy {
namespace energy_test {

using godwit::tests::s;

// Loses a point each EACH_S.
drain_meter measured(double each_s, int points) {
  drain_meter result;
  for (int i = 0; i <= points; ++i)
    result.on_sample(90 - i, static_cast<std::int64_t>(i * each_s * s));
  return result;
}

TEST(drain_meter, measures_whole_points_and_the_time_between_them) {
  const auto drain = measured(10, 6).percent_per_s();
  ASSERT_TRUE(drain);
  EXPECT_NEAR(*drain, 0.1, 1e-9);
}

TEST(drain_meter, says_nothing_before_it_has_measured_long_enough) {
  EXPECT_FALSE(drain_meter().percent_per_s());
  EXPECT_FALSE(measured(30, 2).percent_per_s()) << "one whole point";
  EXPECT_FALSE(measured(5, 4).percent_per_s()) << "15 s";
}

TEST(drain_meter, a_gauge_that_goes_up_and_down_drains_no_faster) {
  drain_meter meter;
  for (int i = 0; i < 600; ++i)
    meter.on_sample(90 - i / 20 + (i % 3 == 0 ? 1 : 0), i * s);
  ASSERT_TRUE(meter.percent_per_s());
  EXPECT_NEAR(*meter.percent_per_s(), 0.05, 0.005);
}

TEST(drain_meter, an_unknown_level_counts_for_nothing) {
  auto meter = measured(10, 6);
  const auto before = meter.percent_per_s();
  meter.on_sample(-1, 100 * s);
  meter.on_sample(101, 101 * s);
  EXPECT_EQ(meter.percent_per_s(), before);
}

TEST(drain_meter, another_battery_is_measured_anew) {
  auto meter = measured(10, 6);
  meter.on_sample(30, 100 * s);
  EXPECT_FALSE(meter.percent_per_s());
}

TEST(energy, the_way_home_climbs_to_the_height_of_the_return_and_lands) {
  const auto low = straight_home(100, 10, 30);
  EXPECT_EQ(low.climb_m, 20);
  EXPECT_EQ(low.descent_m, 30);
  EXPECT_TRUE(low.is_landing);
  const auto high = straight_home(100, 50, 30);
  EXPECT_EQ(high.climb_m, 0);
  EXPECT_EQ(high.descent_m, 50);
  EXPECT_EQ(straight_home(100, -20, 0).climb_m, 20) << "below its home";
}

TEST(energy, a_minute_of_flight_costs_what_a_minute_drains) {
  const auto seconds = seconds_for({.horizontal_m = 300}, pace_of(flight::vehicle_class::multirotor));
  EXPECT_EQ(seconds, 60);
  EXPECT_EQ(spare_percent(50, 25, 0.1, seconds), 19);
}

TEST(energy, what_is_not_known_has_no_verdict) {
  EXPECT_FALSE(spare_percent(-1, 25, 0.1, 60));
  EXPECT_FALSE(spare_percent(101, 25, 0.1, 60));
  EXPECT_FALSE(spare_percent(50, 25, {}, 60));
  EXPECT_FALSE(spare_percent(50, 25, 0.1, {}));
  EXPECT_FALSE(seconds_for({.horizontal_m = std::numeric_limits<double>::quiet_NaN()}, {}));
  EXPECT_FALSE(seconds_for({.horizontal_m = std::numeric_limits<double>::infinity()}, {}));
  EXPECT_FALSE(seconds_for({.horizontal_m = 1}, {.cruise_mps = 0}));
}

TEST(shortage_watch, warns_once_and_again_only_when_there_was_enough_in_between) {
  shortage_watch watch;
  EXPECT_FALSE(watch.becomes_short(1));
  EXPECT_TRUE(watch.becomes_short(0));
  EXPECT_FALSE(watch.becomes_short(-1));
  EXPECT_FALSE(watch.becomes_short(enough_percent - 1));
  EXPECT_FALSE(watch.becomes_short(-1)) << "it has never ended";
  EXPECT_FALSE(watch.becomes_short(enough_percent));
  EXPECT_TRUE(watch.becomes_short(0));
}

TEST(shortage_watch, what_is_not_known_neither_begins_nor_ends_a_warning) {
  shortage_watch watch;
  EXPECT_FALSE(watch.becomes_short({}));
  EXPECT_TRUE(watch.becomes_short(0));
  EXPECT_FALSE(watch.becomes_short({}));
  EXPECT_TRUE(watch.is_short());
}

RC_GTEST_PROP(energy_property, farther_or_with_less_left_never_ends_a_warning, ()) {
  const auto figure = [](int most) { return static_cast<double>(*rc::gen::inRange(0, most)); };
  const auto kind = *rc::gen::element(flight::vehicle_class::multirotor, flight::vehicle_class::fixed_wing,
                                      flight::vehicle_class::rover);
  const auto percent = *rc::gen::inRange(0, 101);
  const auto reserve = *rc::gen::inRange(0, 101);
  const auto drain = figure(2'000) / 1'000;
  const auto height_m = figure(500);
  const auto distance_m = figure(50'000);
  const auto return_m = figure(200);
  const auto spare = [&](int left, double at_m) {
    return spare_percent(left, reserve, drain, seconds_for(straight_home(at_m, height_m, return_m), pace_of(kind)));
  };
  shortage_watch watch;
  (void)watch.becomes_short(spare(percent, distance_m));
  const bool was_short = watch.is_short();
  (void)watch.becomes_short(spare(*rc::gen::inRange(0, percent + 1), distance_m + figure(10'000)));
  RC_ASSERT(!was_short || watch.is_short());
}

RC_GTEST_PROP(energy_property, a_verdict_is_always_a_number, ()) {
  constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  constexpr auto infinite = std::numeric_limits<double>::infinity();
  const auto any = [&] { return *rc::gen::element(nan, infinite, -infinite, -1.0, 0.0, 1e-300, 7.0, 1e300); };
  const auto seconds = seconds_for({any(), any(), any(), *rc::gen::arbitrary<bool>()}, {any(), any(), any(), any()});
  const auto spare = spare_percent(*rc::gen::inRange(-2, 103), 25, any(), seconds);
  RC_ASSERT(!seconds || std::isfinite(*seconds));
  RC_ASSERT(!spare || std::isfinite(*spare));
  const auto home = seconds_for(straight_home(any(), any(), any()), {});
  RC_ASSERT(!home || std::isfinite(*home));
}

RC_GTEST_PROP(energy_property, the_drain_is_never_negative_and_never_not_a_number, ()) {
  drain_meter meter;
  std::int64_t now_ns = 0;
  for (const auto percent : *rc::gen::container<std::vector<int>>(100, rc::gen::inRange(-2, 103))) {
    now_ns += *rc::gen::inRange<std::int64_t>(0, 30 * s);
    meter.on_sample(percent, now_ns);
    const auto drain = meter.percent_per_s();
    RC_ASSERT(!drain || (*drain > 0 && *drain <= max_percent_per_s));
  }
}

TEST(energy, cruise_climb_descent_and_landing_take_their_times_together) {
  const pace how_fast{.cruise_mps = 12, .climb_mps = 2, .descent_mps = 4, .landing_s = 60};
  EXPECT_EQ(seconds_for({120, 30, 20, false}, how_fast), 10 + 15 + 5);
  EXPECT_EQ(seconds_for({120, 30, 20, true}, how_fast), 10 + 15 + 5 + 60);
  EXPECT_EQ(seconds_for({120, 30, 20, true, 9}, how_fast), 10 + 15 + 5 + 60 + 9);
}

TEST(energy, a_way_of_which_a_part_is_not_known_takes_no_time_that_is_known) {
  for (auto part : {&way::horizontal_m, &way::climb_m, &way::descent_m, &way::wait_s})
    for (const auto wrong : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
      way what{1, 1, 1, false};
      what.*part = wrong;
      EXPECT_FALSE(seconds_for(what, {}));
    }
}

} // namespace energy_test
} // namespace godwit::energy
