#include "actors/executor/plan/survey/scan_lines.hpp"

#include <gtest/gtest.h>

namespace godwit::executor::plan {
namespace scan_lines_test {

using line_points = std::vector<line_point>;

const line_points box{{0, 0}, {300, 0}, {300, 100}, {0, 100}};

TEST(scan_lines, rows_are_apart_by_the_spacing_and_stand_in_the_middle) {
  const auto rows = scan_rows(box, 30, 100);
  ASSERT_EQ(rows->size(), 4U);
  EXPECT_DOUBLE_EQ(rows->front().across_m, 5);
  EXPECT_DOUBLE_EQ(rows->back().across_m, 95);
  for (std::size_t i = 1; i < rows->size(); ++i)
    EXPECT_DOUBLE_EQ((*rows)[i].across_m - (*rows)[i - 1].across_m, 30);
}

TEST(scan_lines, an_area_narrower_than_the_spacing_has_one_row_in_its_middle) {
  const auto rows = scan_rows(box, 500, 100);
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_DOUBLE_EQ(rows->front().across_m, 50);
}

TEST(scan_lines, a_dent_divides_a_row) {
  const auto rows =
      scan_rows(line_points{{0, 0}, {300, 0}, {300, 100}, {200, 100}, {150, 20}, {100, 100}, {0, 100}}, 50, 100);
  ASSERT_EQ(rows->size(), 2U);
  ASSERT_EQ(rows->at(1).stretches.size(), 2U);
  EXPECT_NEAR(rows->at(1).stretches[0].to_m, 115.625, 1e-9);
  EXPECT_NEAR(rows->at(1).stretches[1].from_m, 184.375, 1e-9);
}

TEST(scan_lines, a_row_along_a_side_or_through_a_corner_is_counted_once) {
  const line_points stairs{{0, 0}, {200, 0}, {200, 50}, {100, 50}, {100, 100}, {0, 100}};
  const auto rows = scan_rows(stairs, 100, 10); // one row, along the inner side
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_EQ(rows->front().stretches.size(), 1U);
}

TEST(scan_lines, there_is_a_bound) {
  EXPECT_TRUE(scan_rows(box, 1, 100));
  EXPECT_FALSE(scan_rows(box, 0.99, 100));
  EXPECT_FALSE(scan_rows(box, 1e-300, 100));
}

} // namespace scan_lines_test
} // namespace godwit::executor::plan
