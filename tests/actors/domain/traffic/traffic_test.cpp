#include "actors/domain/traffic/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "io/mavlink/enums.hpp"
#include "tests/support/time_units.hpp"

namespace godwit::traffic {
namespace traffic_test {

using godwit::tests::s;
using io::mavlink::adsb_flag;
using io::mavlink::number;

constexpr geo::point here{47.4, 8.5};
constexpr own_motion standing{here, 500, 0, 0, 0};

// At so many metres and degrees from here.
aircraft at(double distance_m, double bearing_deg) {
  aircraft result;
  result.name = "SWR123";
  result.at = geo::destination(here, bearing_deg, distance_m);
  return result;
}

aircraft flying(aircraft what, double course_deg, double speed_mps) {
  what.course_deg = course_deg;
  what.speed_mps = speed_mps;
  return what;
}

io::mavlink::adsb_vehicle report() {
  io::mavlink::adsb_vehicle result;
  result.icao_address = 0x4B1234;
  result.lat = 474'000'000;
  result.lon = 85'000'000;
  result.altitude = 612'345;
  result.heading = 9'050;
  result.hor_velocity = 6'000;
  result.ver_velocity = -250;
  std::string_view("SWR123  ").copy(result.callsign.data(), 8);
  result.tslc = 2;
  result.flags = number(adsb_flag::valid_coords);
  return result;
}

TEST(traffic_report, what_is_not_marked_valid_is_absent_and_not_zero) {
  const auto bare = aircraft_of(report(), 10 * s);
  ASSERT_TRUE(bare);
  EXPECT_EQ(bare->name, "ICAO 4B1234");
  EXPECT_FALSE(bare->altitude_m);
  EXPECT_FALSE(bare->course_deg);
  EXPECT_FALSE(bare->speed_mps);
  EXPECT_FALSE(bare->climb_mps);
  EXPECT_EQ(bare->seen_ns, 8 * s);
}

TEST(traffic_report, each_flag_is_for_its_own_field_and_units_are_ours) {
  auto m = report();
  m.flags = 0xFFFF;
  m.altitude_type = 1;
  const auto all = aircraft_of(m, 0);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->name, "SWR123");
  EXPECT_NEAR(*all->altitude_m, 612.345, 1e-9);
  EXPECT_EQ(all->altitude_by, altitude_source::geometric);
  EXPECT_NEAR(*all->course_deg, 90.5, 1e-9);
  EXPECT_NEAR(*all->speed_mps, 60, 1e-9);
  EXPECT_NEAR(*all->climb_mps, -2.5, 1e-9);
  EXPECT_NEAR(all->at.latitude_deg, 47.4, 1e-9);
  m.flags = number(adsb_flag::valid_coords) | number(adsb_flag::valid_altitude);
  m.altitude_type = io::mavlink::altitude_pressure_qnh;
  const auto some = aircraft_of(m, 0);
  EXPECT_TRUE(some->altitude_m && !some->course_deg && !some->speed_mps && !some->climb_mps);
  EXPECT_EQ(some->altitude_by, altitude_source::pressure);
}

TEST(traffic_report, a_place_that_is_none_is_no_report) {
  auto m = report();
  m.flags = 0;
  EXPECT_FALSE(aircraft_of(m, 0));
  m = report();
  m.lat = 900'000'001;
  EXPECT_FALSE(aircraft_of(m, 0));
  m = report();
  m.lon = -1'800'000'001;
  EXPECT_FALSE(aircraft_of(m, 0));
}

TEST(traffic_report, a_name_has_no_bytes_that_a_callsign_has_not) {
  auto m = report();
  m.flags = 0xFFFF;
  m.callsign = {'<', 'A', '\x80', '1', '"', '\n', 'z', '-', '7'};
  EXPECT_EQ(aircraft_of(m, 0)->name, "A1z-7");
  m.callsign.fill(' ');
  EXPECT_EQ(aircraft_of(m, 0)->name, "ICAO 4B1234");
}

TEST(traffic, one_that_flies_on_is_where_its_course_has_led_since_its_report) {
  const auto other = flying(at(1'000, 0), 180, 50);
  const auto now = approach_of(standing, other, {}, 10 * s);
  EXPECT_NEAR(now.distance_m, 500, 0.01);
  EXPECT_NEAR(now.point->in_s, 10, 0.01);
  EXPECT_NEAR(now.point->distance_m, 0, 0.1);
}

TEST(traffic, of_an_unknown_course_only_the_place_counts) {
  EXPECT_TRUE(approach_of(standing, at(900, 45), {}, 5 * s).is_close);
  const auto far = approach_of(standing, at(1'100, 45), {}, 5 * s);
  EXPECT_FALSE(far.is_close);
  EXPECT_FALSE(far.point);
}

TEST(traffic, of_an_unknown_height_every_height_is_near) {
  auto other = at(100, 45);
  EXPECT_TRUE(approach_of(standing, other, {}, 0).is_close);
  other.altitude_m = 660;
  EXPECT_FALSE(approach_of(standing, other, {}, 0).is_close) << "160 m above";
  other.altitude_m = 640;
  EXPECT_TRUE(approach_of(standing, other, {}, 0).is_close);
}

TEST(traffic, one_that_is_high_above_when_it_is_over_us_and_near_in_height_when_it_is_away_is_not_close) {
  auto other = flying(at(2'000, 0), 180, 100);
  other.altitude_m = 500 + 140;
  other.climb_mps = 20; // after a second above the limit; within the distance after ten
  EXPECT_FALSE(approach_of(standing, other, {}, 0).is_close);
  other.climb_mps = 0;
  EXPECT_TRUE(approach_of(standing, other, {}, 0).is_close);
}

TEST(traffic, what_comes_later_than_the_time_is_not_close_yet) {
  const auto other = flying(at(5'000, 90), 270, 50); // within 1,000 m after 80 s
  EXPECT_FALSE(approach_of(standing, other, {}, 0).is_close);
  EXPECT_TRUE(approach_of(standing, other, {.time_s = 81}, 0).is_close);
}

TEST(traffic, a_sentence_says_where_how_high_and_when) {
  auto other = flying(at(800, 45), 225, 30);
  other.altitude_m = 560;
  EXPECT_EQ(sentence_about(other.name, approach_of(standing, other, {}, 0)),
            "SWR123, 800 m to the north-east, 60 m higher, closest in 27 s at 0 m");
  other.course_deg = 45;
  other.altitude_m = 502;
  EXPECT_EQ(sentence_about(other.name, approach_of(standing, other, {}, 0)),
            "SWR123, 800 m to the north-east, at the same height, not coming nearer");
  other.speed_mps.reset();
  other.altitude_m.reset();
  EXPECT_EQ(sentence_about(other.name, approach_of(standing, other, {}, 0)),
            "SWR123, 800 m to the north-east, height not known, course not known");
}

// -- against a search over time -----------------------------------------------------------------------

double any(int from, int to) { return *rc::gen::inRange(from * 10, to * 10) / 10.0; }

struct meeting {
  own_motion own;
  aircraft other;

  struct apart {
    double over_ground_m;
    double height_m;
  };
  // In the plane of the first bearing, as two that fly straight on.
  [[nodiscard]] apart after(double t_s) const {
    constexpr auto rad = std::numbers::pi / 180;
    const auto distance = geo::distance_m(own.at, other.at);
    const auto bearing = geo::bearing_deg(own.at, other.at) * rad;
    const auto course = *other.course_deg * rad;
    const auto east = distance * std::sin(bearing) + t_s * (*other.speed_mps * std::sin(course) - own.east_mps);
    const auto north = distance * std::cos(bearing) + t_s * (*other.speed_mps * std::cos(course) - own.north_mps);
    const auto height = *other.altitude_m - own.altitude_m + t_s * (*other.climb_mps - own.climb_mps);
    return {std::hypot(east, north), std::abs(height)};
  }
};

meeting any_meeting() {
  meeting result{standing, flying(at(any(0, 4'000), any(0, 360)), any(0, 360), any(0, 120))};
  result.own.north_mps = any(-20, 20);
  result.own.east_mps = any(-20, 20);
  result.own.climb_mps = any(-5, 5);
  result.other.altitude_m = 500 + any(-300, 300);
  result.other.climb_mps = any(-15, 15);
  return result;
}

constexpr double step_s = 0.05;

RC_GTEST_PROP(traffic_property, the_closest_point_is_the_nearest_of_all_moments, ()) {
  const auto all = any_meeting();
  const auto found = approach_of(all.own, all.other, {}, 0);
  RC_ASSERT(found.point.has_value());
  double nearest_m = all.after(0).over_ground_m;
  for (double t = 0; t <= max_ahead_s; t += step_s)
    nearest_m = std::min(nearest_m, all.after(t).over_ground_m);
  RC_ASSERT(found.point->in_s >= 0 && found.point->in_s <= max_ahead_s);
  RC_ASSERT(found.point->distance_m <= nearest_m + 1e-6);
  RC_ASSERT(std::abs(found.point->distance_m - all.after(found.point->in_s).over_ground_m) < 1e-6);
}

RC_GTEST_PROP(traffic_property, close_is_what_comes_within_both_limits_at_one_moment, ()) {
  const auto all = any_meeting();
  const limits set{any(100, 3'000), any(20, 400), any(0, 120)};
  const bool is_close = approach_of(all.own, all.other, set, 0).is_close;
  RC_CLASSIFY(is_close);
  // Wider by what moves within a step, and narrower.
  bool may_be = false;
  bool must_be = false;
  for (double t = 0; t <= set.time_s; t += step_s) {
    const auto then = all.after(t);
    may_be = may_be || (then.over_ground_m <= set.distance_m + 10 && then.height_m <= set.height_m + 2);
    must_be = must_be || (then.over_ground_m <= set.distance_m && then.height_m <= set.height_m);
  }
  RC_ASSERT(!must_be || is_close);
  RC_ASSERT(!is_close || may_be);
}

} // namespace traffic_test
} // namespace godwit::traffic
