#include "actors/ground_port/vehicle_role/current_report.hpp"
#include "tests/support/time_units.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace godwit::ground_port::vehicle_role {
namespace current_report_test {

using godwit::tests::ms;

io::mavlink::mission_current at(std::uint16_t seq) { return {.seq = seq, .total = 5, .mission_state = 3}; }

// The times (ms) at which SAYS(now) is told, looked at each STEP.
template <class Says>
std::vector<std::int64_t> told(current_report& report, std::int64_t to_ms, std::int64_t step_ms, Says says) {
  std::vector<std::int64_t> result;
  for (std::int64_t now = 0; now < to_ms; now += step_ms)
    if (report.due(says(now), now * ms))
      result.push_back(now);
  return result;
}

TEST(current_report, it_is_told_once_a_second_though_nothing_changes) {
  current_report report;
  EXPECT_EQ(told(report, 3'500, 10, [](std::int64_t) { return at(0); }),
            (std::vector<std::int64_t>{0, 1'000, 2'000, 3'000}));
}

TEST(current_report, turns_that_come_late_do_not_shift_those_after_them) {
  current_report report;
  EXPECT_EQ(told(report, 10'000, 30, [](std::int64_t) { return at(0); }).size(), 10U);
}

TEST(current_report, a_change_is_told_within_100_ms) {
  current_report report;
  const auto times = told(report, 900, 1, [](std::int64_t now) { return at(now < 305 ? 0 : 1); });
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 305}));
}

TEST(current_report, changes_that_follow_each_other_faster_than_the_gap_are_told_in_one) {
  current_report report;
  const auto times = told(report, 500, 1, [](std::int64_t now) { return at(now < 300 ? 0 : now < 305 ? 1 : 2); });
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 300, 320}));
}

TEST(current_report, any_field_that_changes_counts) {
  current_report report;
  auto says = at(1);
  EXPECT_TRUE(report.due(says, 0));
  says.fence_id = 7;
  EXPECT_TRUE(report.due(says, 50 * ms));
  says.mission_mode = 2;
  EXPECT_TRUE(report.due(says, 100 * ms));
}

TEST(current_report, without_telling_changes_only_the_period_counts) {
  current_report report(200 * ms, false);
  EXPECT_EQ(told(report, 500, 10, [](std::int64_t now) { return at(static_cast<std::uint16_t>(now)); }),
            (std::vector<std::int64_t>{0, 200, 400}));
}

TEST(current_report, the_next_time_is_known_in_advance) {
  current_report report;
  EXPECT_TRUE(report.due(at(0), 0));
  EXPECT_FALSE(report.due(at(0), 5 * ms));
  EXPECT_EQ(report.next_due_ns(), 1'000 * ms);
  EXPECT_FALSE(report.due(at(1), 5 * ms));
  EXPECT_EQ(report.next_due_ns(), 20 * ms);
}

TEST(current_report, a_station_sets_the_period) {
  current_report report;
  EXPECT_TRUE(report.due(at(0), 0));
  report.set_period(100 * ms, 0);
  EXPECT_TRUE(report.due(at(0), 100 * ms));
  report.set_period(0, 100 * ms);
  EXPECT_FALSE(report.due(at(0), 5'000 * ms));
  EXPECT_TRUE(report.due(at(1), 5'000 * ms));
}

} // namespace current_report_test
} // namespace godwit::ground_port::vehicle_role
