#include "actors/domain/route/corner_points.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/actors/domain/route/fences.hpp"

namespace godwit::route {
namespace corner_points_test {

using tests::box;
using tests::exclusion;
using tests::inclusion;

const geo::local_projection projection(tests::middle);

clear_space space_of(const std::vector<mission::geofence>& fences) { return {fences, projection, {50, 50}, 10}; }

std::size_t points_for(const std::vector<mission::geofence>& fences) { return corner_points(space_of(fences)).size(); }

TEST(corner_points, each_corner_of_an_exclusion_gives_some_and_a_dent_none) {
  EXPECT_EQ(points_for({exclusion(box(0, 0, 100, 100))}), 8U) << "90 degrees in two parts";
  EXPECT_EQ(points_for({exclusion({{0, 0}, {100, 0}, {100, 100}, {50, 20}, {0, 100}})}), 2U * 2 + 2U * 4);
}

TEST(corner_points, an_inclusion_gives_them_at_its_dents_only) {
  EXPECT_EQ(points_for({inclusion(box(0, 0, 100, 100))}), 0U);
  EXPECT_GE(points_for({inclusion({{0, 0}, {200, 0}, {200, 200}, {100, 40}, {0, 200}})}), 3U);
}

TEST(corner_points, where_inclusions_overlap_ways_can_turn) {
  EXPECT_GE(points_for({inclusion(box(0, 0, 300, 100)), inclusion(box(200, 40, 500, 400))}), 1U);
}

RC_GTEST_PROP(corner_points_property, all_are_clear_and_so_is_the_way_around_each_corner, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto space = space_of({exclusion(tests::star(random, {0, 0}, 50, 400))});
  for (const auto& each : corner_points(space)) {
    RC_ASSERT(!space.obstruction_at(each));
    RC_ASSERT(space.exclusions().front().area.distance_to_sides_m(each) >= 10);
  }
}

} // namespace corner_points_test
} // namespace godwit::route
