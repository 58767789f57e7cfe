// Which acts of people are rows of the audit.
#include "actors/ground_port/passing/act_queue.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port::passing {
namespace act_series_test {

using executor::act_kind;
using executor::station_act;

constexpr std::int64_t s = 1'000'000'000;
constexpr executor::station anna{255, 190};
constexpr executor::station bob{254, 190};

TEST(act_series, each_command_is_a_row) {
  act_series rows;
  EXPECT_TRUE(rows.begins({act_kind::arm, anna, "Arm"}, "taken", 0));
  EXPECT_TRUE(rows.begins({act_kind::arm, anna, "Arm"}, "taken", 1));
}

TEST(act_series, a_stream_is_one_until_it_was_silent) {
  act_series rows;
  const station_act sticks{act_kind::stream, anna, "MANUAL_CONTROL"};
  EXPECT_TRUE(rows.begins(sticks, "taken", 0));
  for (std::int64_t at = 1; at <= 20; ++at)
    EXPECT_FALSE(rows.begins(sticks, "taken", at * 4 * s)) << at;
  EXPECT_TRUE(rows.begins(sticks, "taken", 86 * s)) << "silent for six seconds";
}

TEST(act_series, another_station_another_message_and_another_outcome_are_rows) {
  act_series rows;
  EXPECT_TRUE(rows.begins({act_kind::stream, anna, "MANUAL_CONTROL"}, "taken", 0));
  EXPECT_TRUE(rows.begins({act_kind::stream, bob, "MANUAL_CONTROL"}, "taken", 0));
  EXPECT_TRUE(rows.begins({act_kind::stream, anna, "RC_CHANNELS_OVERRIDE"}, "taken", 0));
  EXPECT_TRUE(rows.begins({act_kind::stream, anna, "MANUAL_CONTROL"}, "refused", 0));
  EXPECT_FALSE(rows.begins({act_kind::stream, bob, "MANUAL_CONTROL"}, "taken", 0));
}

TEST(act_series, so_many_parameters_that_are_set_in_a_row_are_one) {
  act_series rows;
  int count = 0;
  for (int i = 0; i < 1'000; ++i)
    count += rows.begins({act_kind::configure, anna, "PARAM_SET"}, "taken", i * s / 50) ? 1 : 0;
  EXPECT_EQ(count, 1);
}

TEST(act_series, over_the_bound_the_one_that_was_heard_longest_ago_is_forgotten) {
  act_series rows;
  const auto by = [](std::size_t number) {
    return station_act{act_kind::stream, {static_cast<std::uint8_t>(number + 1), 190}, "MANUAL_CONTROL"};
  };
  for (std::size_t i = 0; i <= act_series::max_series; ++i)
    EXPECT_TRUE(rows.begins(by(i), "taken", static_cast<std::int64_t>(i)));
  EXPECT_FALSE(rows.begins(by(1), "taken", 100));
  EXPECT_TRUE(rows.begins(by(0), "taken", 100));
}

} // namespace act_series_test
} // namespace godwit::ground_port::passing
