#include "actors/executor/plan/survey/line_order.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace godwit::executor::plan {
namespace line_order_test {

std::vector<scan_row> rows_of(int count, std::initializer_list<stretch> stretches) {
  std::vector<scan_row> rows;
  for (int i = 0; i < count; ++i)
    rows.push_back({10.0 * i, stretches});
  return rows;
}

TEST(line_order, lines_of_a_strip_are_flown_to_and_fro) {
  const auto lines = lines_in_order(rows_of(4, {{0, 100}}), {-50, -50});
  ASSERT_EQ(lines.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(lines[i].from.across_m, 10.0 * static_cast<double>(i));
    EXPECT_EQ(lines[i].from.along_m, i % 2 == 0 ? 0 : 100);
    EXPECT_EQ(lines[i].to.along_m, i % 2 == 0 ? 100 : 0);
  }
}

TEST(line_order, it_begins_at_the_corner_nearest_to_where_the_vehicle_comes_from) {
  const auto rows = rows_of(4, {{0, 100}});
  EXPECT_EQ(lines_in_order(rows, {200, 200}).front().from.along_m, 100);
  EXPECT_EQ(lines_in_order(rows, {200, 200}).front().from.across_m, 30);
  EXPECT_EQ(lines_in_order(rows, {-20, 90}).front().from.along_m, 0);
  EXPECT_EQ(lines_in_order(rows, {-20, 90}).front().from.across_m, 30);
}

TEST(line_order, strips_on_both_sides_of_a_dent_are_flown_one_after_the_other) {
  auto rows = rows_of(2, {{0, 100}});
  for (int i = 2; i < 5; ++i)
    rows.push_back({10.0 * i, {{0, 40}, {60, 100}}});
  const auto lines = lines_in_order(rows, {0, -10});
  ASSERT_EQ(lines.size(), 8U);
  int changes_of_side = 0;
  for (std::size_t i = 3; i < lines.size(); ++i)
    changes_of_side += (lines[i].from.along_m < 50) != (lines[i - 1].from.along_m < 50) ? 1 : 0;
  EXPECT_EQ(changes_of_side, 1);
}

TEST(line_order, each_stretch_is_flown_exactly_once) {
  std::vector<scan_row> rows{
      {0, {{0, 100}}}, {10, {{0, 30}, {50, 100}}}, {20, {{0, 30}, {50, 60}, {80, 100}}}, {30, {{20, 90}}}, {40, {}},
      {50, {{0, 10}}}};
  auto lines = lines_in_order(rows, {0, 0});
  double flown_m = 0;
  for (const auto& each : lines)
    flown_m += std::abs(each.to.along_m - each.from.along_m);
  EXPECT_EQ(lines.size(), 8U);
  EXPECT_DOUBLE_EQ(flown_m, 100 + 30 + 50 + 30 + 10 + 20 + 70 + 10);
}

TEST(line_order, no_rows_are_no_lines) { EXPECT_TRUE(lines_in_order({}, {0, 0}).empty()); }

} // namespace line_order_test
} // namespace godwit::executor::plan
