#include "actors/domain/geo/hilbert.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "actors/domain/geo/geodesic.hpp"

namespace godwit::geo {
namespace hilbert_test {

TEST(hilbert, each_place_is_one_of_its_own) {
  std::set<std::uint64_t> places;
  for (int i = -90; i <= 90; i += 10)
    for (int k = -180; k <= 180; k += 10)
      EXPECT_TRUE(places.insert(hilbert_place({double(i), double(k)})).second) << i << ' ' << k;
}

TEST(hilbert, the_curve_goes_through_the_quadrants_one_after_the_other) {
  const auto quadrant = [](double latitude_deg, double longitude_deg) {
    return hilbert_place({latitude_deg, longitude_deg}) >> 62;
  };
  EXPECT_EQ(quadrant(-45, -90), 0U);
  EXPECT_EQ(quadrant(45, -90), 1U);
  EXPECT_EQ(quadrant(45, 90), 2U);
  EXPECT_EQ(quadrant(-45, 90), 3U);
}

TEST(hilbert, along_the_curve_a_grid_is_walked_from_neighbour_to_neighbour) {
  // Cells of a grid of 2^8 x 2^8 over the whole globe: one step along the curve is one step on the grid.
  constexpr int cells = 256;
  struct cell {
    std::uint64_t place;
    int x, y;
  };
  std::vector<cell> all;
  for (int x = 0; x < cells; ++x)
    for (int y = 0; y < cells; ++y)
      all.push_back({hilbert_place({-90 + 180 * (y + 0.5) / cells, -180 + 360 * (x + 0.5) / cells}), x, y});
  std::sort(all.begin(), all.end(), [](const cell& a, const cell& b) { return a.place < b.place; });
  for (std::size_t i = 1; i < all.size(); ++i)
    ASSERT_EQ(std::abs(all[i].x - all[i - 1].x) + std::abs(all[i].y - all[i - 1].y), 1) << i;
}

} // namespace hilbert_test
} // namespace godwit::geo
