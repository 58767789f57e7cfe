#include "actors/domain/geofence/coverage.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace godwit::geofence {
namespace coverage_test {

const geo::flat_polygon box({{0, 0}, {100, 0}, {100, 100}, {0, 100}});
const geo::flat_polygon next_box({{100, 0}, {300, 0}, {300, 100}, {100, 100}});

std::optional<double> leaves(const geo::segment& way, double margin_m = 0) {
  const std::vector<way_over> areas{{&box, way, {}}};
  return leaves_at(areas, margin_m);
}

TEST(coverage, it_is_known_where_a_way_leaves) {
  EXPECT_NEAR(*leaves({{50, 50}, {250, 50}}), 0.25, 1e-9);
  EXPECT_NEAR(*leaves({{50, 50}, {250, 50}}, 10), 0.2, 1e-9);
  EXPECT_EQ(leaves({{150, 50}, {250, 50}}), 0.0);
  EXPECT_EQ(leaves({{0, 0}, {0, 100}}), std::nullopt) << "a side is inside";
}

TEST(coverage, areas_that_share_a_side_count_together) {
  const geo::segment way{{50, 50}, {250, 50}};
  const std::vector<way_over> areas{{&box, way, {}}, {&next_box, way, {}}};
  EXPECT_EQ(leaves_at(areas, 0), std::nullopt);
  EXPECT_TRUE(leaves_at(areas, 1)) << "nothing there keeps the margin to both";
}

TEST(coverage, an_area_counts_on_its_part_of_the_way_only) {
  const geo::segment way{{10, 50}, {90, 50}};
  const std::vector<way_over> gap{{&box, way, {0, 0.5}}, {&box, way, {0.6, 1}}};
  EXPECT_NEAR(*leaves_at(gap, 0), 0.5, 1e-9);
  const std::vector<way_over> whole{{&box, way, {0, 0.5}}, {&box, way, {0.5, 1}}};
  EXPECT_EQ(leaves_at(whole, 0), std::nullopt);
}

TEST(coverage, without_areas_nothing_is_covered) { EXPECT_EQ(leaves_at({}, 0), 0.0); }

} // namespace coverage_test
} // namespace godwit::geofence
