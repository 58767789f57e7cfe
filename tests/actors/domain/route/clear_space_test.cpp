#include "actors/domain/route/clear_space.hpp"

#include <gtest/gtest.h>

#include "tests/actors/domain/route/fences.hpp"

namespace godwit::route {
namespace clear_space_test {

using tests::box;
using tests::exclusion;
using tests::inclusion;

const geo::local_projection projection(tests::middle);
constexpr altitude_band at_50{50, 50};

clear_space space_of(const std::vector<mission::geofence>& fences, const altitude_band& altitudes = at_50,
                     double margin_m = 10) {
  return {fences, projection, altitudes, margin_m};
}

TEST(clear_space, without_fences_everything_is_clear) {
  const auto space = space_of({});
  EXPECT_FALSE(space.obstruction_at({1000, -1000}));
  EXPECT_TRUE(space.is_clear({{0, 0}, {5000, 0}}));
}

TEST(clear_space, an_exclusion_keeps_away_by_the_margin) {
  const auto space = space_of({exclusion(box(0, 0, 100, 100))});
  EXPECT_EQ(space.obstruction_at({50, 50})->distance_m, 0);
  EXPECT_NEAR(space.obstruction_at({-6, 50})->distance_m, 6, 0.01);
  EXPECT_EQ(space.obstruction_at({-6, 50})->fence, 0U);
  EXPECT_FALSE(space.obstruction_at({-10.1, 50}));
  EXPECT_FALSE(space.obstruction_at_without_margin({-6, 50}));
}

TEST(clear_space, a_way_is_blocked_where_it_comes_too_near_between_its_ends) {
  const auto space = space_of({exclusion(box(0, 0, 100, 100))});
  EXPECT_FALSE(space.is_clear({{-100, 50}, {200, 50}}));
  EXPECT_FALSE(space.is_clear({{-100, 105}, {200, 105}}));
  EXPECT_TRUE(space.is_clear({{-100, 111}, {200, 111}}));
  EXPECT_FALSE(space.is_clear({{40, 50}, {60, 50}})) << "all of it lies inside";
}

TEST(clear_space, who_is_outside_of_all_inclusions_is_nowhere) {
  const auto space = space_of({inclusion(box(0, 0, 100, 100)), inclusion(box(500, 0, 600, 100))});
  EXPECT_FALSE(space.obstruction_at({50, 50}));
  EXPECT_FALSE(space.obstruction_at({550, 50}));
  EXPECT_EQ(space.obstruction_at({300, 50})->fence, std::nullopt);
  EXPECT_NEAR(space.obstruction_at({95, 50})->distance_m, 5, 0.01);
  EXPECT_FALSE(space.is_clear({{50, 50}, {550, 50}}));
}

TEST(clear_space, a_way_goes_from_one_inclusion_into_another_where_they_overlap) {
  const auto space = space_of({inclusion(box(0, 0, 300, 100)), inclusion(box(200, 0, 500, 100))});
  EXPECT_TRUE(space.is_clear({{50, 50}, {450, 50}}));
  EXPECT_FALSE(space.is_clear({{50, 50}, {450, 95}}));
  const auto touching = space_of({inclusion(box(0, 0, 300, 100)), inclusion(box(300, 0, 500, 100))});
  EXPECT_FALSE(touching.is_clear({{50, 50}, {450, 50}})) << "nothing there keeps the margin to both";
}

TEST(clear_space, an_exclusion_above_or_below_is_no_obstacle) {
  auto fence = exclusion(box(0, 0, 100, 100));
  fence.floor_m = 60;
  EXPECT_FALSE(space_of({fence}).obstruction_at({50, 50}));
  EXPECT_TRUE(space_of({fence}, {50, 60}).obstruction_at({50, 50}));
  fence.floor_m.reset();
  fence.ceiling_m = 40;
  EXPECT_FALSE(space_of({fence}).obstruction_at({50, 50}));
}

TEST(clear_space, an_inclusion_that_does_not_reach_over_all_altitudes_is_no_place_to_be) {
  auto fence = inclusion(box(0, 0, 100, 100));
  fence.ceiling_m = 60;
  EXPECT_FALSE(space_of({fence}).is_empty());
  EXPECT_TRUE(space_of({fence}, {50, 70}).is_empty());
  EXPECT_TRUE(space_of({fence}, {50, 70}).obstruction_at({50, 50}));
}

TEST(clear_space, who_is_too_near_may_fly_away_and_not_nearer) {
  const auto space = space_of({exclusion(box(0, 0, 100, 100))});
  EXPECT_FALSE(space.is_clear({{-4, 50}, {-200, 50}}));
  EXPECT_TRUE(space.is_clear_from_here({{-4, 50}, {-200, 50}}));
  EXPECT_FALSE(space.is_clear_from_here({{-4, 50}, {-2, 200}}));
  EXPECT_FALSE(space.is_clear_from_here({{4, 50}, {-200, 50}})) << "from inside of it nothing leads on";
}

TEST(clear_space, who_is_too_near_to_the_edge_of_an_inclusion_may_fly_inwards) {
  const auto space = space_of({inclusion(box(0, 0, 100, 100))});
  EXPECT_TRUE(space.is_clear_from_here({{3, 50}, {50, 50}}));
  EXPECT_FALSE(space.is_clear_from_here({{3, 50}, {1, 80}}));
}

} // namespace clear_space_test
} // namespace godwit::route
