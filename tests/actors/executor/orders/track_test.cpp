#include "actors/executor/flight/watches/track.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/enums.hpp"

namespace godwit::executor {
namespace track_test {

constexpr std::int64_t s = 1'000'000'000;
constexpr double metre = 1 / 111'195.0; // degrees of latitude

io::mavlink::mission_item_int waypoint(std::uint16_t sequence, double north_m) {
  io::mavlink::mission_item_int result;
  result.seq = sequence;
  result.command = io::mavlink::number(io::mavlink::mav_cmd::nav_waypoint);
  result.x = static_cast<std::int32_t>((47 + north_m * metre) * 1e7);
  result.y = 80'000'000;
  return result;
}

geo::point at(double north_m) { return {47 + north_m * metre, 8}; }

track flown_past(double farthest_m, std::int64_t gap_ns) {
  track result;
  result.begin({waypoint(1, 100), waypoint(2, 300)}, flight::vehicle_class::multirotor, 30, 0);
  std::int64_t now_ns = s;
  result.on_position(at(0), now_ns);
  result.on_left(now_ns);
  for (double metres = 0; metres <= farthest_m; metres += 2)
    result.on_position(at(metres), now_ns += metres == 40 ? gap_ns : s / 5);
  return result;
}

TEST(track, a_place_that_was_passed_is_not_contradicted) {
  EXPECT_EQ(flown_past(120, s / 5).never_near(1, 1), std::vector<std::uint16_t>{});
}

TEST(track, a_place_that_was_never_near_is_contradicted_with_the_distance) {
  const auto flown = flown_past(200, s / 5);
  EXPECT_EQ(flown.never_near(1, 2), std::vector<std::uint16_t>{2});
  EXPECT_NEAR(flown.nearest_m(2).value_or(0), 100, 2);
}

TEST(track, within_the_margin_nothing_is_contradicted) {
  EXPECT_EQ(flown_past(286, s / 5).never_near(2, 2), std::vector<std::uint16_t>{});
  EXPECT_EQ(flown_past(280, s / 5).never_near(2, 2), std::vector<std::uint16_t>{2});
  EXPECT_EQ(flown_past(272, s / 5).never_near(2, 2, 2), std::vector<std::uint16_t>{}) << "the vehicle says so itself";
  EXPECT_EQ(flown_past(266, s / 5).never_near(2, 2, 2), std::vector<std::uint16_t>{2});
}

TEST(track, a_gap_in_which_it_may_have_been_there_contradicts_nothing) {
  EXPECT_EQ(flown_past(200, 30 * s).never_near(2, 2), std::vector<std::uint16_t>{});
}

TEST(track, a_gap_in_which_it_can_not_have_been_there_hides_nothing) {
  EXPECT_EQ(flown_past(200, 2 * s).never_near(2, 2), std::vector<std::uint16_t>{2});
}

TEST(track, between_two_positions_it_was_on_the_straight) {
  track flown;
  flown.on_position(at(0), s);
  flown.begin({waypoint(1, 100)}, flight::vehicle_class::multirotor, 30, s);
  flown.on_position(at(80), 2 * s);
  EXPECT_EQ(flown.never_near(1, 1), std::vector<std::uint16_t>{1});
  flown.on_position(at(120), 3 * s);
  EXPECT_EQ(flown.never_near(1, 1), std::vector<std::uint16_t>{});
  EXPECT_NEAR(flown.nearest_m(1).value_or(-1), 0, 0.1);
}

// The first position after a plan is brought may come a second later.
TEST(track, positions_from_before_the_plan_count) {
  track flown;
  flown.on_position(at(0), s);
  flown.begin({waypoint(1, 100)}, flight::vehicle_class::multirotor, 30, 2 * s);
  flown.on_position(at(10), 3 * s);
  EXPECT_EQ(flown.never_near(1, 1), std::vector<std::uint16_t>{1});
}

TEST(track, without_positions_nothing_is_contradicted) {
  track flown;
  flown.begin({waypoint(1, 100)}, flight::vehicle_class::multirotor, 30, 0);
  EXPECT_EQ(flown.never_near(1, 1), std::vector<std::uint16_t>{});
}

} // namespace track_test
} // namespace godwit::executor
