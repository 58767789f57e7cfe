#include "actors/domain/geo/mgrs.hpp"

#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/actors/domain/geo/places.hpp"

namespace godwit::geo {
namespace mgrs_test {

// The places and names that the manual of GeoConvert gives: 33.3 N 44.4 E is 38SMB4488.
TEST(mgrs, published_names_come_out) {
  EXPECT_EQ(mgrs_cell({33.3, 44.4}, cell_size::m_100), "38SMB441847");
  EXPECT_EQ(mgrs_cell({21.3098, -157.9167}, cell_size::km_10), "04QFJ15");
}

TEST(mgrs, both_names_of_the_antimeridian_lie_in_the_same_cell) {
  EXPECT_EQ(mgrs_cell({10, 180}, cell_size::m_10), mgrs_cell({10, -180}, cell_size::m_10));
}

TEST(mgrs, beyond_the_grid_of_zones_the_polar_grid_begins) {
  EXPECT_EQ(mgrs_cell({90, 0}, cell_size::m_10), "ZAH00000000");
  EXPECT_EQ(mgrs_cell({-90, 0}, cell_size::m_10), "BAN00000000");
  EXPECT_EQ(read_mgrs_cell("ZAH00000000"), "ZAH00000000");
}

TEST(mgrs, a_name_is_read_in_one_form_only) {
  EXPECT_EQ(read_mgrs_cell("4QFJ12345678"), "04QFJ12345678");
  EXPECT_EQ(read_mgrs_cell("04QFJ1234"), "04QFJ1234");
  EXPECT_EQ(read_mgrs_cell("33UXP0123456789"), "33UXP0123456789");
}

TEST(mgrs, what_names_no_cell_is_refused) {
  for (const auto* bad : {"", "4", "4QFJ", "4Q", "4QFJ123", "61QFJ1234", "4IFJ1234", "4QFJ12345678901234", "4qfj1234",
                          "4QFJ 1234", "INV", "INVALID", "nonsense", "4QFJ12\n4"})
    EXPECT_FALSE(read_mgrs_cell(bad)) << bad;
}

RC_GTEST_PROP(mgrs_property, the_cells_of_a_place_have_each_the_name_of_its_size, ()) {
  const auto at = *tests::anywhere();
  const auto all = mgrs_cells(at);
  std::set<std::string> different(all.begin(), all.end());
  RC_ASSERT(different.size() == all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    RC_ASSERT(all[i] == mgrs_cell(at, cell_sizes[i]));
    RC_ASSERT(read_mgrs_cell(all[i]) == all[i]);
  }
}

} // namespace mgrs_test
} // namespace godwit::geo
