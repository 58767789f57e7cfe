// The geometry against a reference that shares nothing with it but the projection: whether corners go around a place is
// told by the sum of their angles, in a picture around the place itself, and a way is looked at in 200 places.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geofence/fence_set.hpp"
#include "tests/actors/domain/geofence/random_fences.hpp"

namespace godwit::geofence {
namespace reference_test {

using fence_list = std::vector<mission::geofence>;

struct seen_from_place {
  bool is_inside = false;
  double to_sides_m = 0;
};

seen_from_place look_around(const geo::point& at, const mission::geofence& fence) {
  const geo::local_projection around(at);
  std::vector<std::pair<double, double>> corners;
  for (const auto& each : fence.vertices) {
    const auto flat = around.to_local({each.latitude, each.longitude});
    corners.emplace_back(flat.east_m, flat.north_m);
  }
  double angles = 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [ax, ay] = corners[i];
    const auto [bx, by] = corners[(i + 1) % corners.size()];
    angles += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
    const double length = std::hypot(bx - ax, by - ay);
    const double share = std::clamp(-(ax * (bx - ax) + ay * (by - ay)) / (length * length), 0.0, 1.0);
    nearest_m = std::min(nearest_m, std::hypot(ax + share * (bx - ax), ay + share * (by - ay)));
  }
  // Once around is inside; where a fence that crosses itself runs around twice is outside again.
  return {std::lround(angles / (2 * std::numbers::pi)) % 2 != 0, nearest_m};
}

enum class verdict { clear, breach, too_near_to_say };

// A place that is SLACK or more from all sides, floors and ceilings has one verdict.
verdict look_at(const place& at, const fence_list& fences, double slack_m) {
  bool must = false;
  bool is_in_one = false;
  bool is_in_exclusion = false;
  for (const auto& each : fences) {
    const auto seen = look_around(at.at, each);
    const double below_m = at.altitude_m - each.floor_m.value_or(-1e9);
    const double above_m = each.ceiling_m.value_or(1e9) - at.altitude_m;
    if (seen.to_sides_m < slack_m || std::abs(below_m) < 1e-6 || std::abs(above_m) < 1e-6)
      return verdict::too_near_to_say;
    const bool is_inside = seen.is_inside && below_m > 0 && above_m > 0;
    const bool keeps_in = each.kind == mission::fence_kind::inclusion;
    must = must || keeps_in;
    is_in_one = is_in_one || (keeps_in && is_inside);
    is_in_exclusion = is_in_exclusion || (!keeps_in && is_inside);
  }
  return is_in_exclusion || (must && !is_in_one) ? verdict::breach : verdict::clear;
}

// A side of 100 km is not the same line in two pictures; up to 10 km it is, to a millimetre.
double slack_m(const tests::fence_world& world) { return world.scale_m() < 5'000 ? 0.003 : 5; }

bool keeps_to_plan(const fence_set& fences, const place& from, const place& to) {
  const auto [low, high] = std::minmax(from.altitude_m, to.altitude_m);
  const altitude_band band{low, high};
  for (std::size_t i = 0; i < fences.size(); ++i)
    if (fences.excludes(i, from.at, to.at, band))
      return false;
  return !fences.leaves_inclusions_at(from.at, to.at, band);
}

RC_GTEST_PROP(geofence_reference, a_place_has_the_same_verdict, (std::uint64_t seed)) {
  tests::fence_world world(seed);
  const auto fences = fence_set::build(world.fences).value();
  for (int i = 0; i < 20; ++i) {
    const auto at = world.some_place();
    const auto expected = look_at(at, world.fences, slack_m(world));
    if (expected != verdict::too_near_to_say)
      RC_ASSERT(fences.breach_at(at).has_value() == (expected == verdict::breach));
  }
}

RC_GTEST_PROP(geofence_reference, a_way_is_a_breach_where_one_of_its_places_is, (std::uint64_t seed)) {
  tests::fence_world world(seed, 0.5, 4'000);
  const auto fences = fence_set::build(world.fences).value();
  for (int i = 0; i < 10; ++i) {
    const auto from = world.some_place();
    const auto to = world.some_place();
    const geo::local_projection around(from.at);
    const auto way = around.to_local(to.at);
    bool is_breached = false;
    for (int step = 0; step <= 200 && !is_breached; ++step) {
      const double share = step / 200.0;
      const place at{around.to_globe({share * way.east_m, share * way.north_m}),
                     from.altitude_m + share * (to.altitude_m - from.altitude_m)};
      is_breached = look_at(at, world.fences, slack_m(world)) == verdict::breach;
    }
    if (is_breached)
      RC_ASSERT(fences.breach_on(from, to).has_value());
  }
}

RC_GTEST_PROP(geofence_reference, a_way_far_from_all_sides_has_the_verdict_of_its_places, (std::uint64_t seed)) {
  tests::fence_world world(seed, 0.5, 4'000);
  const auto fences = fence_set::build(world.fences).value();
  for (int i = 0; i < 20; ++i) {
    const auto from = world.some_place();
    const geo::local_projection around(from.at);
    const double length_m = world.number(0, 0.2) * world.scale_m();
    const double bearing = world.number(0, 2 * std::numbers::pi);
    const auto to = around.to_globe({length_m * std::cos(bearing), length_m * std::sin(bearing)});
    const auto expected = look_at(from, world.fences, length_m + slack_m(world));
    if (expected != verdict::too_near_to_say)
      RC_ASSERT(fences.breach_on(from, {to, from.altitude_m}).has_value() == (expected == verdict::breach));
  }
}

// What preflight lets pass is no breach in flight, wherever on the way the vehicle climbs.
RC_GTEST_PROP(geofence_reference, what_a_plan_may_fly_is_no_breach_in_flight, (std::uint64_t seed)) {
  tests::fence_world world(seed);
  const auto fences = fence_set::build(world.fences).value();
  for (int i = 0; i < 20; ++i) {
    const auto from = world.some_place();
    const auto to = world.some_place();
    const bool keeps = keeps_to_plan(fences, from, to);
    if (!keeps)
      continue;
    RC_ASSERT(!fences.breach_on(from, to));
    RC_ASSERT(!fences.breach_on({from.at, to.altitude_m}, to));
    RC_ASSERT(!fences.breach_on(from, {to.at, from.altitude_m}));
  }
}

} // namespace reference_test
} // namespace godwit::geofence
