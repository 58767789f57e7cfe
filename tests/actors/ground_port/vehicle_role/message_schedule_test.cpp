#include "actors/ground_port/vehicle_role/message_schedule.hpp"
#include "tests/support/time_units.hpp"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace godwit::ground_port::vehicle_role {
namespace message_schedule_test {

using godwit::tests::ms;
constexpr std::array table{streamed_message{30, 250 * ms}, streamed_message{33, 1'000 * ms}, streamed_message{242, 0}};

// The ids that are due between FROM and TO, looked at each STEP.
std::vector<std::uint32_t> due_between(message_schedule& what, std::int64_t from_ns, std::int64_t to_ns,
                                       std::int64_t step_ns = 10 * ms) {
  std::vector<std::uint32_t> result;
  for (auto now = from_ns; now < to_ns; now += step_ns)
    what.for_each_due(now, [&](std::uint32_t id) { result.push_back(id); });
  return result;
}

auto count(const std::vector<std::uint32_t>& ids, std::uint32_t id) { return std::count(ids.begin(), ids.end(), id); }

TEST(message_schedule, each_message_comes_at_its_interval) {
  message_schedule schedule(table, 0);
  const auto ids = due_between(schedule, 0, 2'000 * ms);
  EXPECT_EQ(count(ids, 30), 8);
  EXPECT_EQ(count(ids, 33), 2);
  EXPECT_EQ(count(ids, 242), 0);
}

TEST(message_schedule, turns_that_come_late_do_not_shift_those_after_them) {
  message_schedule schedule(table, 0);
  EXPECT_EQ(count(due_between(schedule, 0, 10'000 * ms, 70 * ms), 30), 40);
}

TEST(message_schedule, what_was_missed_is_not_made_up_for) {
  message_schedule schedule(table, 0);
  const auto ids = due_between(schedule, 5'000 * ms, 5'001 * ms, ms);
  EXPECT_EQ(count(ids, 30), 1);
  EXPECT_EQ(schedule.next_due_ns(), 5'250 * ms);
}

TEST(message_schedule, the_phase_spreads_the_first_ones_over_their_intervals) {
  message_schedule schedule(table, 0, 0.5);
  EXPECT_EQ(schedule.next_due_ns(), 125 * ms);
}

TEST(message_schedule, a_station_sets_an_interval_stops_a_message_and_goes_back_to_the_default) {
  message_schedule schedule(table, 0);
  EXPECT_TRUE(schedule.set_interval(242, 100'000, 0));
  EXPECT_EQ(schedule.interval_us(242), 100'000);
  EXPECT_EQ(count(due_between(schedule, 0, 1'000 * ms), 242), 10);
  EXPECT_TRUE(schedule.set_interval(30, -1, 1'000 * ms));
  EXPECT_EQ(schedule.interval_us(30), -1);
  EXPECT_EQ(count(due_between(schedule, 1'000 * ms, 2'000 * ms), 30), 0);
  EXPECT_TRUE(schedule.set_interval(30, 0, 2'000 * ms));
  EXPECT_EQ(schedule.interval_us(30), 250'000);
  EXPECT_EQ(count(due_between(schedule, 2'000 * ms, 3'000 * ms), 30), 4);
}

TEST(message_schedule, asking_again_for_the_same_interval_sends_nothing_more) {
  message_schedule schedule(table, 0);
  std::int64_t sent = 0;
  for (std::int64_t now = 0; now < 1'000 * ms; now += 10 * ms) {
    EXPECT_TRUE(schedule.set_interval(30, 250'000, now));
    schedule.for_each_due(now, [&](std::uint32_t id) { sent += id == 30 ? 1 : 0; });
  }
  EXPECT_EQ(sent, 4);
}

TEST(message_schedule, unknown_ids_and_intervals_that_are_none_are_refused) {
  message_schedule schedule(table, 0);
  EXPECT_FALSE(schedule.set_interval(77, 1'000, 0));
  EXPECT_FALSE(schedule.set_interval(30, -2, 0));
  EXPECT_FALSE(schedule.set_interval(30, std::numeric_limits<std::int64_t>::max(), 0));
  EXPECT_EQ(schedule.interval_us(77), 0);
  EXPECT_EQ(schedule.interval_us(30), 250'000);
}

TEST(message_schedule, no_message_comes_more_often_than_a_thousand_times_a_second) {
  message_schedule schedule(table, 0);
  EXPECT_TRUE(schedule.set_interval(30, 1, 0));
  EXPECT_EQ(schedule.interval_us(30), 1'000);
}

TEST(message_schedule, with_nothing_to_stream_nothing_is_ever_due) {
  message_schedule schedule({}, 0);
  EXPECT_EQ(schedule.next_due_ns(), std::numeric_limits<std::int64_t>::max());
}

} // namespace message_schedule_test
} // namespace godwit::ground_port::vehicle_role
