#include "actors/domain/traffic/sky.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "io/mavlink/enums.hpp"
#include "tests/support/time_units.hpp"

namespace godwit::traffic {
namespace sky_test {

using godwit::tests::s;

constexpr geo::point here{47.4, 8.5};

io::mavlink::adsb_vehicle report(std::uint32_t icao, double distance_m = 1'000) {
  const auto at = geo::destination(here, 90, distance_m);
  io::mavlink::adsb_vehicle result;
  result.icao_address = icao;
  result.lat = static_cast<std::int32_t>(at.latitude_deg * 1e7);
  result.lon = static_cast<std::int32_t>(at.longitude_deg * 1e7);
  result.flags = io::mavlink::number(io::mavlink::adsb_flag::valid_coords);
  return result;
}

bool holds(const sky& all, std::uint32_t icao) {
  return std::ranges::find(all.all(), icao, &aircraft::icao) != all.all().end();
}

TEST(sky, has_one_of_each_address_with_its_newest_report_whoever_brings_it) {
  sky all;
  all.take(report(1), here, 10 * s);
  auto late = report(1, 5'000);
  late.tslc = 3;
  all.take(late, here, 10 * s);
  ASSERT_EQ(all.all().size(), 1U);
  EXPECT_EQ(all.all().front().seen_ns, 10 * s) << "the other one's was older";
  all.take(late, here, 14 * s);
  EXPECT_EQ(all.all().front().seen_ns, 11 * s);
}

TEST(sky, one_without_a_report_for_a_minute_is_forgotten) {
  sky all;
  all.take(report(1), here, 0);
  auto old = report(2);
  old.tslc = 59;
  all.take(old, here, 0);
  old.icao_address = 3;
  old.tslc = 60;
  all.take(old, here, 0);
  EXPECT_TRUE(holds(all, 2));
  EXPECT_FALSE(holds(all, 3)) << "it is heard of a minute late";
  all.forget_old(s);
  EXPECT_FALSE(holds(all, 2));
  all.forget_old(60 * s - 1);
  EXPECT_TRUE(holds(all, 1));
  all.forget_old(60 * s);
  EXPECT_TRUE(all.all().empty());
}

TEST(sky, keeps_the_nearest_and_counts_what_has_no_room) {
  sky all;
  for (std::uint32_t i = 1; i <= sky::max_aircraft; ++i)
    all.take(report(i, i * 100.0), here, s);
  EXPECT_EQ(all.without_room(), 0U);
  all.take(report(1'000, 50), here, s);
  EXPECT_TRUE(holds(all, 1'000));
  EXPECT_FALSE(holds(all, sky::max_aircraft)) << "the farthest";
  all.take(report(1'001, 50'000), here, s);
  EXPECT_FALSE(holds(all, 1'001));
  EXPECT_EQ(all.all().size(), sky::max_aircraft);
  EXPECT_EQ(all.without_room(), 2U);
}

TEST(sky, while_our_own_place_is_not_known_the_oldest_makes_room) {
  sky all;
  for (std::uint32_t i = 1; i <= sky::max_aircraft + 1; ++i)
    all.take(report(i), std::nullopt, i * s / 10);
  EXPECT_FALSE(holds(all, 1));
  EXPECT_TRUE(holds(all, 2));
}

TEST(sky, what_has_no_place_is_counted_and_dropped) {
  sky all;
  auto nowhere = report(1);
  nowhere.flags = 0;
  all.take(nowhere, here, 0);
  EXPECT_TRUE(all.all().empty());
  EXPECT_EQ(all.without_place(), 1U);
}

} // namespace sky_test
} // namespace godwit::traffic
