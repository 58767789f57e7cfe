#include "actors/domain/route/route.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/geo/polygon.hpp"
#include "tests/actors/domain/geo/places.hpp"
#include "tests/actors/domain/route/fences.hpp"

namespace godwit::route {
namespace route_test {

using tests::box;
using tests::exclusion;
using tests::inclusion;
using tests::place;

using fence_list = std::vector<mission::geofence>;

route_request from_to(const geo::point& from, const geo::point& to, double margin_m = 10) {
  return {from, to, {50, 50}, margin_m};
}

geo::polygon polygon_of(const mission::geofence& fence) {
  std::vector<geo::point> corners;
  for (const auto& each : fence.vertices)
    corners.push_back({each.latitude, each.longitude});
  return geo::polygon(corners);
}

// Inside or nearer than METRES, looked at on the ellipsoid and not as the route does it.
bool is_within(double metres, const geo::point& at, const geo::polygon& area) {
  if (area.contains(at))
    return true;
  for (int bearing = 0; bearing < 360; bearing += 30)
    if (area.contains(geo::destination(at, bearing, metres)))
      return true;
  return false;
}

std::vector<geo::point> along(const route& way, double step_m) {
  std::vector<geo::point> places{way.points.front()};
  for (std::size_t i = 1; i < way.points.size(); ++i) {
    const geo::local_projection flat(way.points[i - 1]);
    const auto to = flat.to_local(way.points[i]);
    const int steps = static_cast<int>(std::ceil(std::hypot(to.east_m, to.north_m) / step_m));
    for (int step = 1; step <= steps; ++step)
      places.push_back(flat.to_globe({to.east_m * step / steps, to.north_m * step / steps}));
  }
  return places;
}

TEST(route, straight_where_nothing_is_in_the_way) {
  const auto found = find_route(from_to(place(0, 0), place(1000, 0)), fence_list{});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->points.size(), 2U);
  EXPECT_NEAR(found->length_m, 1000, 0.01);
}

TEST(route, around_an_exclusion_with_the_margin) {
  const fence_list fences{exclusion(box(-50, -200, 50, 100))};
  const auto found = find_route(from_to(place(-500, 0), place(500, 0)), fences);
  ASSERT_TRUE(found);
  EXPECT_GT(found->points.size(), 2U);
  EXPECT_NEAR(found->length_m, 2 * std::hypot(450, 110) + 100, 3);
  for (const auto& each : along(*found, 2))
    EXPECT_FALSE(is_within(9.9, each, polygon_of(fences[0])));
}

// The places at which a vehicle can be that turns up to RADIUS before each corner and flies straight to the next place.
std::vector<geo::point> with_cut_corners(const route& way, double radius_m) {
  std::vector<geo::point> places;
  for (std::size_t i = 1; i + 1 < way.points.size(); ++i) {
    const geo::local_projection corner(way.points[i]);
    const auto before = corner.to_local(way.points[i - 1]);
    const auto next = corner.to_local(way.points[i + 1]);
    const double length_m = std::hypot(before.east_m, before.north_m);
    for (const double part : {0.5, 1.0}) {
      const double early = std::min(1.0, part * radius_m / length_m);
      const geo::local_point from{early * before.east_m, early * before.north_m};
      for (int step = 0; step <= 40; ++step)
        places.push_back(corner.to_globe({from.east_m + step / 40.0 * (next.east_m - from.east_m),
                                          from.north_m + step / 40.0 * (next.north_m - from.north_m)}));
    }
  }
  return places;
}

bool keeps_away(const std::vector<geo::point>& places, double metres, const mission::geofence& fence) {
  const auto area = polygon_of(fence);
  return std::none_of(places.begin(), places.end(), [&](const auto& each) { return is_within(metres, each, area); });
}

TEST(route, the_margin_holds_where_the_vehicle_cuts_a_corner) {
  const auto sharp = exclusion({{-400, 0}, {0, -40}, {0, 40}});
  auto request = from_to(place(-300, -200), place(-300, 200));
  const auto without = find_route(request, fence_list{sharp});
  ASSERT_TRUE(without);
  EXPECT_FALSE(keeps_away(with_cut_corners(*without, 5), 9.9, sharp)) << "else this shows nothing";
  request.turn_room_m = 5;
  const auto found = find_route(request, fence_list{sharp});
  ASSERT_TRUE(found);
  EXPECT_GT(found->points.size(), 2U);
  EXPECT_TRUE(keeps_away(with_cut_corners(*found, 5), 9.9, sharp));
}

TEST(route, a_destination_at_the_margin_is_reached_though_there_is_no_room_to_turn_at_it) {
  auto request = from_to(place(-500, 0), place(61, 0));
  request.turn_room_m = 5;
  const auto found = find_route(request, fence_list{exclusion(box(-50, -200, 50, 100))});
  ASSERT_TRUE(found);
  EXPECT_GT(found->points.size(), 2U);
}

TEST(route, inside_of_a_dented_inclusion_it_goes_around_the_dent) {
  const fence_list fences{inclusion({{-500, -500}, {500, -500}, {500, 500}, {0, -300}, {-500, 500}})};
  const auto found = find_route(from_to(place(-400, 200), place(400, 200)), fences);
  ASSERT_TRUE(found);
  EXPECT_GT(found->points.size(), 2U);
  for (const auto& each : along(*found, 2))
    EXPECT_TRUE(polygon_of(fences[0]).contains(each));
}

TEST(route, from_one_inclusion_into_the_next_around_the_corner_between_them) {
  const fence_list fences{inclusion(box(0, 0, 300, 1000)), inclusion(box(200, 700, 1000, 1000))};
  const auto found = find_route(from_to(place(100, 100), place(900, 750)), fences);
  ASSERT_TRUE(found);
  for (const auto& each : along(*found, 2))
    EXPECT_TRUE(polygon_of(fences[0]).contains(each) || polygon_of(fences[1]).contains(each));
}

TEST(route, refused_with_the_reason_when_there_is_no_way) {
  const fence_list ring{exclusion({{-300, -300},
                                   {300, -300},
                                   {300, 300},
                                   {-300, 300},
                                   {-300, 10},
                                   {-200, 10},
                                   {-200, 200},
                                   {200, 200},
                                   {200, -200},
                                   {-200, -200},
                                   {-200, -1},
                                   {-300, -1}})};
  const auto found = find_route(from_to(place(-1000, 0), place(0, 0)), ring);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, route_errc::no_way) << "the gap is narrower than the margin on both sides";
  EXPECT_EQ(found.error().reason, "There is no way to the destination that keeps 10.0 m away from the fences.");
  EXPECT_TRUE(find_route(from_to(place(-1000, 4), place(0, 0), 5), ring));
}

TEST(route, refused_when_the_destination_is_in_a_fence_or_too_near_to_one) {
  const fence_list fences{inclusion(box(-900, -900, 900, 900)), exclusion(box(0, 0, 100, 100))};
  const auto inside = find_route(from_to(place(-500, 0), place(50, 50)), fences);
  ASSERT_FALSE(inside);
  EXPECT_EQ(inside.error().code, route_errc::end_is_blocked);
  EXPECT_EQ(inside.error().fence, 1U);
  EXPECT_EQ(inside.error().reason, "The destination lies inside geofence 2, which excludes it.");
  const auto near = find_route(from_to(place(-500, 0), place(-4, 50)), fences);
  ASSERT_FALSE(near);
  EXPECT_EQ(near.error().reason, "The destination is 4.0 m from geofence 2; keep 10.0 m away from it.");
  const auto outside = find_route(from_to(place(-500, 0), place(2000, 50)), fences);
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().reason, "The destination lies outside of all inclusion fences.");
}

TEST(route, refused_when_the_vehicle_has_broken_a_fence) {
  const fence_list fences{exclusion(box(0, 0, 100, 100))};
  const auto found = find_route(from_to(place(50, 50), place(500, 0)), fences);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, route_errc::start_is_blocked);
}

TEST(route, a_vehicle_that_is_too_near_to_a_fence_flies_away_from_it) {
  const fence_list fences{exclusion(box(0, 0, 100, 100))};
  const auto found = find_route(from_to(place(-3, 50), place(500, 50)), fences);
  ASSERT_TRUE(found);
  for (const auto& each : along(*found, 2))
    EXPECT_FALSE(is_within(2.9, each, polygon_of(fences[0])));
}

TEST(route, refused_when_no_inclusion_reaches_over_the_altitude) {
  fence_list fences{inclusion(box(-900, -900, 900, 900))};
  fences[0].ceiling_m = 40;
  const auto found = find_route(from_to(place(0, 0), place(100, 0)), fences);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, route_errc::no_fence_there);
}

TEST(route, a_fence_above_the_altitude_is_no_obstacle) {
  fence_list fences{exclusion(box(-50, -200, 50, 100))};
  fences[0].floor_m = 80;
  EXPECT_EQ(find_route(from_to(place(-500, 0), place(500, 0)), fences)->points.size(), 2U);
}

TEST(route, bounds_have_a_defined_result) {
  const auto code_of = [](const route_request& request, const fence_list& fences) {
    const auto found = find_route(request, fences);
    return found ? std::nullopt : std::optional(found.error().code);
  };
  EXPECT_EQ(code_of(from_to(place(0, 0), place(60'000, 0)), {}), route_errc::too_far);
  EXPECT_EQ(code_of(from_to(place(0, 0), place(10, 0), 0.1), {}), route_errc::wrong_request);
  EXPECT_EQ(code_of(from_to(place(0, 0), place(10, 0), std::nan("")), {}), route_errc::wrong_request);
  auto roomy = from_to(place(0, 0), place(10, 0));
  roomy.turn_room_m = std::nan("");
  EXPECT_EQ(code_of(roomy, {}), route_errc::wrong_request);
  EXPECT_EQ(code_of(from_to({95, 0}, {0, 0}), {}), route_errc::wrong_request);
  const fence_list many(max_corners / 4 + 1, exclusion(box(-50, -50, 50, 50)));
  EXPECT_EQ(code_of(from_to(place(-500, 0), place(500, 0)), many), route_errc::too_many_corners);
}

TEST(route, the_antimeridian_runs_through_it) {
  const geo::point around{-17, 179.999};
  const fence_list fences{tests::fence(mission::fence_kind::exclusion, box(-50, -200, 250, 100), around)};
  const auto found = find_route(from_to(place(-500, 0, around), place(700, 0, around)), fences);
  ASSERT_TRUE(found);
  EXPECT_LT(found->length_m, 1300);
  for (const auto& each : along(*found, 2))
    EXPECT_FALSE(is_within(9.9, each, polygon_of(fences[0])));
}

// Fences that may overlap, within 2 km.
fence_list some_fences(std::mt19937_64& random) {
  std::uniform_real_distribution<double> anywhere(-900, 900);
  fence_list fences;
  const int count = std::uniform_int_distribution<int>(1, 6)(random);
  for (int i = 0; i < count; ++i)
    fences.push_back(exclusion(tests::star(random, {anywhere(random), anywhere(random)}, 40, 350)));
  if (std::uniform_int_distribution<int>(0, 2)(random) == 0)
    fences.push_back(inclusion(tests::star(random, {0, 0}, 900, 1500)));
  return fences;
}

geo::point some_place(std::mt19937_64& random) {
  std::uniform_real_distribution<double> anywhere(-1200, 1200);
  const double east_m = anywhere(random);
  return place(east_m, anywhere(random));
}

RC_GTEST_PROP(route_property, a_route_never_comes_nearer_to_a_fence_than_the_margin, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto fences = some_fences(random);
  const auto request = from_to(some_place(random), some_place(random), *tests::number_between(1, 30));
  const auto found = find_route(request, fences);
  RC_CLASSIFY(!found.has_value(), "refused");
  if (!found)
    return;
  RC_ASSERT(found->length_m >= geo::distance_m(request.from, request.to) - 0.001);
  // On its first leg it may be as near as the vehicle was.
  double allowed_m = request.margin_m - 0.05;
  for (const auto& fence : fences) {
    const auto area = polygon_of(fence);
    if (fence.kind == mission::fence_kind::exclusion)
      while (allowed_m > 0 && is_within(allowed_m, request.from, area))
        allowed_m -= 0.5;
  }
  for (const auto& at : along(*found, 5))
    for (const auto& fence : fences) {
      const auto area = polygon_of(fence);
      if (fence.kind == mission::fence_kind::exclusion)
        RC_ASSERT(!(allowed_m > 0 ? is_within(allowed_m, at, area) : area.contains(at)));
      else
        RC_ASSERT(area.contains(at));
    }
}

RC_GTEST_PROP(route_property, cut_corners_come_no_nearer_to_an_exclusion_than_the_margin, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  fence_list fences;
  for (const double east_m : {-500.0, 0.0, 500.0})
    fences.push_back(exclusion(tests::star(random, {east_m, 0}, 40, 350)));
  auto request = from_to(place(-1100, -100), place(1100, 100), *tests::number_between(5, 30));
  request.turn_room_m = *tests::number_between(0, 20);
  const auto found = find_route(request, fences);
  RC_CLASSIFY(!found.has_value(), "refused");
  if (!found)
    return;
  for (const auto& fence : fences)
    RC_ASSERT(keeps_away(with_cut_corners(*found, request.turn_room_m), request.margin_m - 0.05, fence));
}

// Three fences beside each other, and an end that is OFF from a corner of the last one.
struct crowded {
  fence_list fences;
  route_request request;

  crowded(std::uint64_t seed, const geo::local_point& off, double margin_m, double turn_room_m) {
    std::mt19937_64 random(seed);
    std::vector<geo::local_point> last;
    for (const double east_m : {-300.0, 0.0, 300.0}) {
      last = tests::star(random, {east_m, 0}, 40, 350);
      fences.push_back(exclusion(last));
    }
    const auto near = last[std::uniform_int_distribution<std::size_t>(0, last.size() - 1)(random)] + off;
    request = from_to(place(-1100, -100), place(near.east_m, near.north_m), margin_m);
    request.turn_room_m = turn_room_m;
  }

  [[nodiscard]] bool keeps_margin(const route& found) const {
    return std::ranges::all_of(fences, [&](const auto& each) {
      return keeps_away(with_cut_corners(found, request.turn_room_m), request.margin_m - 0.05, each);
    });
  }
};

TEST(route, the_margin_holds_on_the_last_leg_of_a_vehicle_that_has_cut_the_corner_before_it) {
  const crowded seen(7688108510737392579U, {17.8462, -15.0263}, 5, 2.79048);
  const auto found = find_route(seen.request, seen.fences);
  ASSERT_TRUE(found);
  EXPECT_GT(found->points.size(), 2U);
  EXPECT_TRUE(seen.keeps_margin(*found));
}

// Whatever the fences are, and also where the end lies at the margin of one.
RC_GTEST_PROP(route_property, a_vehicle_that_turns_early_keeps_the_margin_to_the_end, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const double east_m = *tests::number_between(-40, 40);
  const double north_m = *tests::number_between(-40, 40);
  const double margin_m = *tests::number_between(5, 15);
  const crowded seen(seed, {east_m, north_m}, margin_m, *tests::number_between(1, 12));
  const auto found = find_route(seen.request, seen.fences);
  RC_CLASSIFY(!found.has_value(), "refused");
  RC_CLASSIFY(found.has_value() && found->points.size() > 2, "with turns");
  if (found)
    RC_ASSERT(seen.keeps_margin(*found));
}

RC_GTEST_PROP(route_property, the_way_back_is_as_long, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto fences = some_fences(random);
  const auto a = some_place(random);
  const auto b = some_place(random);
  const auto there = find_route(from_to(a, b), fences);
  const auto back = find_route(from_to(b, a), fences);
  const auto is_blocked = [](const auto& found) {
    return !found &&
           (found.error().code == route_errc::end_is_blocked || found.error().code == route_errc::start_is_blocked);
  };
  if (is_blocked(there) || is_blocked(back)) // a start may be nearer to a fence than an end may
    return;
  RC_ASSERT(there.has_value() == back.has_value());
  if (there)
    RC_ASSERT(std::abs(there->length_m - back->length_m) < 0.01);
}

RC_GTEST_PROP(route_property, a_route_is_never_longer_than_going_around_the_box_of_the_fence, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto corners = tests::star(random, {0, 0}, 50, 400);
  const double margin_m = *tests::number_between(1, 30);
  geo::local_point low{};
  geo::local_point high{};
  for (const auto& each : corners) {
    low = {std::min(low.east_m, each.east_m), std::min(low.north_m, each.north_m)};
    high = {std::max(high.east_m, each.east_m), std::max(high.north_m, each.north_m)};
  }
  const double out_m = margin_m + 1;
  const geo::local_point west{low.east_m - out_m - *tests::number_between(0, 500), 0};
  const geo::local_point east{high.east_m + out_m + *tests::number_between(0, 500), 0};
  const auto length_over = [&](double north_m) {
    return std::hypot(low.east_m - out_m - west.east_m, north_m) + (high.east_m - low.east_m + 2 * out_m) +
           std::hypot(east.east_m - high.east_m - out_m, north_m);
  };
  const double trivial_m = std::min(length_over(high.north_m + out_m), length_over(low.north_m - out_m));
  const auto found =
      find_route(from_to(place(west.east_m, 0), place(east.east_m, 0), margin_m), fence_list{exclusion(corners)});
  RC_ASSERT(found.has_value());
  RC_ASSERT(found->length_m <= trivial_m + 0.1);
}

} // namespace route_test
} // namespace godwit::route
