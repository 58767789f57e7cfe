#include "actors/executor/traffic_view.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"
#include "tests/support/time_units.hpp"

namespace godwit::executor {
namespace traffic_view_test {

using godwit::tests::s;
using io::mavlink::adsb_flag;

constexpr traffic::limits usual{};
constexpr std::int32_t here_lat = 474'000'000;
constexpr std::int32_t here_lon = 85'000'000;
constexpr std::int32_t lat_of_km = 89'932; // a kilometre to the north

io::mavlink::global_position_int own_place() {
  return {.lat = here_lat, .lon = here_lon, .alt = 500'000, .relative_alt = 20'000};
}

// To the north of it, and flying to the east at 40 m/s.
io::mavlink::adsb_vehicle to_the_north(std::uint32_t icao, double km) {
  io::mavlink::adsb_vehicle result;
  result.icao_address = icao;
  result.lat = here_lat + static_cast<std::int32_t>(km * lat_of_km);
  result.lon = here_lon;
  result.altitude = 550'000;
  result.heading = 9'000;
  result.hor_velocity = 4'000;
  result.flags = io::mavlink::number(adsb_flag::valid_coords) | io::mavlink::number(adsb_flag::valid_altitude) |
                 io::mavlink::number(adsb_flag::valid_heading) | io::mavlink::number(adsb_flag::valid_velocity);
  return result;
}

TEST(traffic_view, shows_the_nearest_first_as_seen_from_the_vehicle) {
  traffic_view view;
  view.take(own_place(), 0);
  view.take(to_the_north(0xA, 5), 0);
  view.take(to_the_north(0xB, 0.8), 0);
  const auto seen = view.all(usual, 0);
  ASSERT_EQ(seen.aircraft.size(), 2U);
  const auto& first = seen.aircraft[0];
  EXPECT_EQ(first.icao, 0xBU);
  EXPECT_TRUE(first.is_close);
  EXPECT_NEAR(*first.distance_m, 800, 1);
  EXPECT_NEAR(*first.height_m, 50, 0.01);
  EXPECT_EQ(first.altitude_by, "pressure");
  auto bare = to_the_north(0xC, 6);
  bare.flags = io::mavlink::number(adsb_flag::valid_coords);
  view.take(bare, 0);
  EXPECT_EQ(view.all(usual, 0).aircraft.at(2).altitude_by, "") << "it has no altitude";
  EXPECT_EQ(first.sentence, "ICAO 00000B, 800 m to the north, 50 m higher, not coming nearer");
  EXPECT_FALSE(seen.aircraft[1].is_close);
}

TEST(traffic_view, where_the_vehicle_is_not_known_no_distance_is_told_and_nothing_is_close) {
  traffic_view view;
  view.take(to_the_north(0xA, 0.5), 0);
  EXPECT_FALSE(view.all(usual, 0).aircraft.at(0).distance_m);
  view.take(own_place(), s);
  EXPECT_TRUE(view.all(usual, 4 * s).aircraft.at(0).distance_m);
  const auto old = view.all(usual, 4 * s + 1);
  EXPECT_FALSE(old.aircraft.at(0).distance_m);
  EXPECT_FALSE(old.aircraft.at(0).is_close);
  auto nowhere = own_place();
  nowhere.lat = std::numeric_limits<std::int32_t>::max();
  view.take(nowhere, 4 * s);
  EXPECT_FALSE(view.all(usual, 4 * s).aircraft.at(0).distance_m);
}

TEST(traffic_view, what_was_not_reported_for_a_minute_is_not_shown) {
  traffic_view view;
  view.take(own_place(), 0);
  view.take(to_the_north(0xA, 5), 0);
  EXPECT_EQ(view.all(usual, 60 * s - 1).aircraft.size(), 1U);
  EXPECT_NEAR(view.all(usual, 10 * s).aircraft[0].age_s, 10, 1e-6);
  EXPECT_TRUE(view.all(usual, 60 * s).aircraft.empty());
}

TEST(traffic_view, a_warning_of_the_autopilot_names_the_aircraft_and_what_it_does_and_ends_with_its_threat) {
  traffic_view view;
  auto known = to_the_north(0xA, 5);
  known.flags |= io::mavlink::number(adsb_flag::valid_callsign);
  known.callsign = {'S', 'W', 'R', '1'};
  view.take(known, 0);
  io::mavlink::collision warning{.id = 0xA, .action = 2, .threat_level = 2};
  warning.time_to_minimum_delta = 12;
  warning.horizontal_minimum_delta = 40;
  view.take(warning, 0);
  ASSERT_EQ(view.all(usual, 0).warnings.size(), 1U);
  EXPECT_EQ(view.all(usual, 0).warnings[0],
            "the autopilot warns of a collision with SWR1, closest in 12 s at 40 m, and climbs or descends");
  warning.action = 99;
  warning.time_to_minimum_delta = std::numeric_limits<float>::quiet_NaN();
  view.take(warning, s);
  EXPECT_EQ(view.all(usual, s).warnings.at(0),
            "the autopilot warns of a collision with SWR1, and does something that is not known here");
  EXPECT_TRUE(view.all(usual, 11 * s).warnings.empty()) << "it was not repeated";
  view.take(warning, 12 * s);
  warning.threat_level = 0;
  view.take(warning, 13 * s);
  EXPECT_TRUE(view.all(usual, 13 * s).warnings.empty());
}

TEST(traffic_view, warnings_are_bounded_and_the_oldest_makes_room) {
  traffic_view view;
  for (std::uint32_t i = 0; i <= traffic_view::max_warnings; ++i)
    view.take(io::mavlink::collision{.id = i, .threat_level = 1}, s);
  const auto all = view.warnings(s);
  ASSERT_EQ(all.size(), traffic_view::max_warnings);
  EXPECT_EQ(all.front().id, 1U);
}

TEST(traffic_view, a_way_is_near_an_aircraft_that_crosses_it_while_it_is_flown) {
  traffic_view view;
  view.take(own_place(), 0);
  auto other = to_the_north(0xA, 3);
  other.lon = here_lon - 10 * 132'600; // some 10 km to the west: it crosses after 250 s
  view.take(other, 0);
  const mission::position there{(here_lat + 3 * lat_of_km) / 1e7, here_lon / 1e7, 20};
  EXPECT_EQ(view.on_way(there, 100, usual, 0), "") << "there before it";
  const auto slowly = view.on_way(there, 10, usual, 0);
  EXPECT_NE(slowly.find("ICAO 00000A"), std::string::npos) << slowly;
  auto high = there;
  high.altitude_m = 900;
  EXPECT_EQ(view.on_way(high, 10, usual, 0), "") << "far above it by then";
  EXPECT_EQ(view.on_way(there, 10, usual, 4 * s), "") << "where the vehicle is, is not known any more";
}

} // namespace traffic_view_test
} // namespace godwit::executor
