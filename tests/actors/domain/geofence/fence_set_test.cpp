#include "actors/domain/geofence/fence_set.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/actors/domain/geofence/fences.hpp"

namespace fence_set_test {

using namespace godwit::geofence;
using namespace godwit::tests;
using godwit::mission::fence_kind;
using godwit::mission::geofence;

fence_set set_of(const std::vector<geofence>& fences) { return fence_set::build(fences).value(); }

geofence keep_in(const std::vector<metres>& corners) { return fence_of(fence_kind::inclusion, corners); }
geofence keep_out(const std::vector<metres>& corners) { return fence_of(fence_kind::exclusion, corners); }

TEST(fence_set, without_fences_nothing_is_breached) {
  const fence_set none;
  EXPECT_EQ(none.size(), 0U);
  EXPECT_FALSE(none.breach_at(place_at(0, 0)));
  EXPECT_FALSE(none.breach_on(place_at(0, 0), place_at(1'000, 0)));
}

TEST(fence_set, with_inclusion_fences_it_must_be_inside_at_least_one) {
  const auto judge = set_of({keep_in(square(100)), keep_in(square(100, 150, 0))});
  EXPECT_FALSE(judge.breach_at(place_at(0, 0)));
  EXPECT_FALSE(judge.breach_at(place_at(200, 0)));
  const auto found = judge.breach_at(place_at(300, 0));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->exclusion, std::nullopt);
  EXPECT_EQ(found->sentence(), "it is outside of all inclusion fences");
}

TEST(fence_set, it_must_be_inside_no_exclusion_fence) {
  const auto judge = set_of({keep_out(square(10)), keep_out(square(10, 50, 0))});
  EXPECT_FALSE(judge.breach_at(place_at(30, 0)));
  const auto found = judge.breach_at(place_at(50, 0));
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, (breach{1}));
  EXPECT_EQ(found->sentence(), "it is in geofence 2, which excludes it");
}

TEST(fence_set, an_exclusion_inside_an_inclusion_is_a_breach) {
  const auto judge = set_of({keep_in(square(100)), keep_out(square(10))});
  EXPECT_TRUE(judge.breach_at(place_at(0, 0)));
  EXPECT_FALSE(judge.breach_at(place_at(50, 0)));
}

// As ArduPilot and PX4 count: PNPOLY, the even-odd rule.
TEST(fence_set, where_a_fence_overlaps_itself_is_outside_of_it) {
  const std::vector<metres> star{{0, 100}, {59, -81}, {-95, 31}, {95, 31}, {-59, -81}};
  const auto stays_in = set_of({keep_in(star)});
  EXPECT_FALSE(stays_in.breach_at(place_at(0, 60))) << "in its upper point";
  EXPECT_TRUE(stays_in.breach_at(place_at(0, 0))) << "in its middle";
  EXPECT_TRUE(stays_in.breach_on(place_at(0, 60), place_at(40, -60))) << "through the middle, from point to point";
  EXPECT_FALSE(set_of({keep_out(star)}).breach_at(place_at(0, 0)));
}

TEST(fence_set, on_the_edge_counts_as_inside_for_both) {
  const auto judge = set_of({keep_in(square(100)), keep_out(square(10))});
  EXPECT_FALSE(judge.breach_at(place_at(100, 0))) << "inside of what keeps in";
  EXPECT_TRUE(judge.breach_at(place_at(10, 0))) << "inside of what keeps out";
}

TEST(fence_set, above_the_ceiling_is_outside_of_an_inclusion_and_over_an_exclusion) {
  const auto judge = set_of(
      {fence_of(fence_kind::inclusion, square(100), {}, 120), fence_of(fence_kind::exclusion, square(10), {}, 60)});
  EXPECT_TRUE(judge.breach_at(place_at(50, 0, 121)));
  EXPECT_FALSE(judge.breach_at(place_at(0, 0, 61))) << "it flies over";
  EXPECT_TRUE(judge.breach_at(place_at(0, 0, 60)));
}

TEST(fence_set, a_leg_through_an_exclusion_is_a_breach_though_both_ends_are_clear) {
  const auto judge = set_of({keep_out(square(2))});
  EXPECT_FALSE(judge.breach_at(place_at(-5, 0)));
  EXPECT_FALSE(judge.breach_at(place_at(5, 0)));
  EXPECT_TRUE(judge.breach_on(place_at(-5, 0), place_at(5, 0)));
  EXPECT_FALSE(judge.breach_on(place_at(-5, 3), place_at(5, 3)));
}

TEST(fence_set, a_leg_that_touches_the_corner_of_an_exclusion_is_a_breach) {
  const auto judge = set_of({keep_out(square(2))});
  EXPECT_TRUE(judge.breach_on(place_at(0, 4), place_at(4, 0)));
  EXPECT_FALSE(judge.breach_on(place_at(0, 4.1), place_at(4.1, 0)));
}

TEST(fence_set, a_leg_along_the_side_of_an_exclusion_is_a_breach) {
  const auto judge = set_of({keep_out(square(2))});
  EXPECT_TRUE(judge.breach_on(place_at(-5, 2), place_at(5, 2)));
}

TEST(fence_set, a_leg_that_cuts_a_bay_of_an_inclusion_is_a_breach_though_both_ends_are_inside) {
  const auto judge = set_of({keep_in({{0, 0}, {100, 0}, {100, 100}, {50, 20}, {0, 100}})});
  EXPECT_TRUE(judge.breach_on(place_at(10, 80), place_at(90, 80)));
  EXPECT_FALSE(judge.breach_on(place_at(10, 10), place_at(90, 10)));
}

TEST(fence_set, a_leg_from_one_inclusion_into_another_that_meets_it_is_none) {
  const auto judge = set_of({keep_in(square(100)), keep_in(square(100, 150, 0)), keep_in(square(50, 300, 0))});
  EXPECT_FALSE(judge.breach_on(place_at(0, 0), place_at(200, 0)));
  EXPECT_FALSE(judge.breach_on(place_at(200, 0), place_at(300, 0))) << "side by side, and the side belongs to both";
  const auto gap = set_of({keep_in(square(100)), keep_in(square(100, 201, 0))});
  EXPECT_TRUE(gap.breach_on(place_at(0, 0), place_at(200, 0)));
}

TEST(fence_set, a_leg_that_climbs_through_an_exclusion_is_a_breach_and_one_over_it_is_none) {
  const auto judge = set_of({fence_of(fence_kind::exclusion, square(20), 40, 60)});
  EXPECT_TRUE(judge.breach_on(place_at(0, 0, 30), place_at(1, 0, 70)));
  EXPECT_FALSE(judge.breach_on(place_at(-50, 0, 70), place_at(50, 0, 70)));
  EXPECT_TRUE(judge.breach_on(place_at(-50, 0, 50), place_at(50, 0, 50)));
}

TEST(fence_set, a_leg_across_the_antimeridian_is_straight) {
  const auto judge = set_of({fence_of(fence_kind::inclusion, square(200), {}, {}, near_antimeridian),
                             fence_of(fence_kind::exclusion, square(2, 60, 0), {}, {}, near_antimeridian)});
  const auto from = place_at(-100, 0, 50, near_antimeridian);
  const auto to = place_at(100, 0, 50, near_antimeridian);
  EXPECT_GT(from.at.longitude_deg, 0);
  EXPECT_LT(to.at.longitude_deg, 0);
  EXPECT_EQ(judge.breach_on(from, to), (breach{1}));
  EXPECT_FALSE(judge.breach_on(place_at(-100, 10, 50, near_antimeridian), place_at(100, 10, 50, near_antimeridian)));
}

TEST(fence_set, a_leg_of_no_length_is_a_place) {
  const auto judge = set_of({keep_in(square(100))});
  EXPECT_FALSE(judge.breach_on(place_at(1, 1), place_at(1, 1)));
  EXPECT_TRUE(judge.breach_on(place_at(101, 1), place_at(101, 1)));
}

TEST(fence_set, a_floor_that_does_not_count_is_that_of_inclusions_only) {
  const auto judge =
      set_of({fence_of(fence_kind::inclusion, square(100), 20), fence_of(fence_kind::exclusion, square(10), 30)});
  EXPECT_FALSE(judge.breach_at(place_at(0, 0, 5), false)) << "below what keeps out";
  EXPECT_TRUE(judge.breach_at(place_at(0, 0, 5), true));
  EXPECT_FALSE(judge.breach_on(place_at(-50, 0, 5), place_at(50, 0, 5), false));
}

TEST(fence_set, too_many_fences_and_broken_ones_are_refused_with_the_number) {
  const auto many = fence_set::build(std::vector<geofence>(max_fences + 1, keep_in(square(10))));
  ASSERT_FALSE(many);
  EXPECT_NE(many.error().find("at most 100"), std::string::npos);
  const auto broken = fence_set::build({keep_in(square(10)), keep_in({{0, 0}})});
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().find("geofence 2 has 1 corners"), 0U);
}

// What a thousand points of the way say, the cuts must say too.
RC_GTEST_PROP(fence_set_property, a_leg_breaches_where_one_of_its_points_does, ()) {
  const auto metre = [] { return *rc::gen::inRange(-40, 40) * 1.0; };
  std::vector<geofence> fences;
  const int count = *rc::gen::inRange(1, 4);
  for (int i = 0; i < count; ++i) {
    const auto kind = *rc::gen::element(fence_kind::inclusion, fence_kind::exclusion);
    const auto low_m = *rc::gen::inRange(0, 40) * 1.0;
    const auto half_m = *rc::gen::inRange(1, 40) * 1.0;
    fences.push_back(fence_of(kind, square(half_m, metre(), metre()), low_m, low_m + *rc::gen::inRange(0, 40)));
  }
  const auto judge = set_of(fences);
  const auto from = place_at(metre(), metre(), *rc::gen::inRange(0, 80));
  const auto to = place_at(metre(), metre(), *rc::gen::inRange(0, 80));
  const godwit::geo::local_projection around(home);
  const auto a = around.to_local(from.at);
  const auto b = around.to_local(to.at);
  bool point_breaches = false;
  for (int i = 0; i <= 200 && !point_breaches; ++i) {
    const double t = i / 200.0;
    const godwit::geo::local_point there{a.east_m + t * (b.east_m - a.east_m), a.north_m + t * (b.north_m - a.north_m)};
    const auto altitude_m = from.altitude_m + t * (to.altitude_m - from.altitude_m);
    point_breaches = judge.breach_at(place{around.to_globe(there), altitude_m}).has_value();
  }
  const bool leg_breaches = judge.breach_on(from, to).has_value();
  RC_TAG(leg_breaches);
  RC_ASSERT(!point_breaches || leg_breaches);
}

RC_GTEST_PROP(fence_set_property, a_leg_and_its_way_back_have_one_verdict, ()) {
  const auto metre = [] { return *rc::gen::inRange(-4'000, 4'000) / 100.0; };
  const auto judge = set_of({keep_in(square(30)), keep_out(square(5, metre(), metre()))});
  const auto from = place_at(metre(), metre());
  const auto to = place_at(metre(), metre());
  RC_ASSERT(judge.breach_on(from, to).has_value() == judge.breach_on(to, from).has_value());
}

TEST(fence_set, only_an_exclusion_excludes_a_way_and_only_at_its_heights) {
  const auto fences = fence_set::build({fence_of(fence_kind::inclusion, square(10)),
                                        fence_of(fence_kind::exclusion, square(10), 20, 40)})
                          .value();
  const auto from = place_at(-20, 0).at;
  const auto to = place_at(20, 0).at;
  EXPECT_FALSE(fences.excludes(0, from, to, {30, 30}));
  EXPECT_TRUE(fences.excludes(1, from, to, {30, 30}));
  EXPECT_TRUE(fences.excludes(1, from, to, {0, 20}));
  EXPECT_FALSE(fences.excludes(1, from, to, {41, 60}));
  EXPECT_FALSE(fences.excludes(1, from, place_at(-20, 50).at, {30, 30}));
}

TEST(fence_set, it_is_known_where_a_way_leaves_the_inclusions_that_have_all_its_heights) {
  const auto inside = place_at(0, 0).at;
  const auto outside = place_at(20, 0).at;
  const auto free = fence_set::build({fence_of(fence_kind::exclusion, square(10))}).value();
  EXPECT_FALSE(free.leaves_inclusions_at(inside, outside, {30, 30}));
  const auto low = fence_set::build({fence_of(fence_kind::inclusion, square(10), {}, 40),
                                     fence_of(fence_kind::exclusion, square(100))})
                       .value();
  EXPECT_FALSE(low.leaves_inclusions_at(inside, place_at(5, 0).at, {30, 30}));
  EXPECT_NEAR(low.leaves_inclusions_at(inside, outside, {30, 30}).value_or(-1), 0.5, 1e-6);
  EXPECT_NEAR(low.leaves_inclusions_at(outside, inside, {30, 30}).value_or(-1), 0, 1e-6);
  EXPECT_NEAR(low.leaves_inclusions_at(inside, place_at(5, 0).at, {30, 50}).value_or(-1), 0, 1e-6);
}

} // namespace fence_set_test
