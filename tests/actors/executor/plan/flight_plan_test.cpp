#include "actors/executor/plan/flight_plan.hpp"

#include <gtest/gtest.h>

namespace godwit::executor::plan {
namespace flight_plan_test {

TEST(flight_plan, a_line_is_done_when_the_vehicle_is_on_its_way_behind_its_end) {
  const planned_survey survey{3, 0, 10, 4}; // its lines are 10-11, 12-13, 14-15, 16-17
  EXPECT_EQ(lines_done_at(survey, 9), 0U);
  EXPECT_EQ(lines_done_at(survey, 10), 0U);
  EXPECT_EQ(lines_done_at(survey, 11), 0U);
  EXPECT_EQ(lines_done_at(survey, 12), 1U);
  EXPECT_EQ(lines_done_at(survey, 17), 3U);
  EXPECT_EQ(lines_done_at(survey, 18), 4U);
  EXPECT_EQ(lines_done_at(survey, 40), 4U);
}

TEST(flight_plan, lines_of_earlier_plans_count_too) { EXPECT_EQ(lines_done_at({3, 5, 1, 4}, 4), 6U); }

} // namespace flight_plan_test
} // namespace godwit::executor::plan
