#include "actors/executor/plan/survey/best_heading.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/actors/domain/route/fences.hpp"

namespace godwit::executor::plan {
namespace best_heading_test {

using corner_list = std::vector<geo::local_point>;

// Of the area across lines of this heading.
double width_m(const corner_list& corners, double heading_deg) {
  const double heading = heading_deg * std::numbers::pi / 180;
  double low = 1e9;
  double high = -1e9;
  for (const auto& each : corners) {
    const double across = each.east_m * std::cos(heading) - each.north_m * std::sin(heading);
    low = std::min(low, across);
    high = std::max(high, across);
  }
  return high - low;
}

TEST(best_heading, along_the_long_side_of_a_box) {
  EXPECT_NEAR(best_heading_deg(tests::box(0, 0, 300, 100)), 90, 1e-9);
  EXPECT_NEAR(best_heading_deg(tests::box(0, 0, 100, 300)), 0, 1e-9);
}

TEST(best_heading, dents_do_not_count) {
  EXPECT_NEAR(best_heading_deg(corner_list{{0, 0}, {300, 0}, {300, 100}, {160, 100}, {150, 5}, {140, 100}, {0, 100}}),
              90, 1e-9);
}

RC_GTEST_PROP(best_heading_property, no_other_heading_needs_fewer_lines, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto corners = tests::star(random, {0, 0}, 50, 400);
  const double best_deg = best_heading_deg(corners);
  RC_ASSERT(best_deg >= 0 && best_deg < 180);
  for (int heading_deg = 0; heading_deg < 180; ++heading_deg)
    RC_ASSERT(width_m(corners, best_deg) <= width_m(corners, heading_deg) + 0.01);
}

} // namespace best_heading_test
} // namespace godwit::executor::plan
