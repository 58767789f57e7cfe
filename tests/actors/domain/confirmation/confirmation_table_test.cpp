#include "actors/domain/confirmation/confirmation_table.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::domain {
namespace confirmation_table_test {

using godwit::tests::s;

TEST(confirmation_table, three_frames_are_not_enough_and_the_fourth_within_five_seconds_is) {
  confirmation_table table;
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(table.note(7, heartbeats_to_believe, i * s));
  EXPECT_TRUE(table.note(7, heartbeats_to_believe, 3 * s));
  EXPECT_TRUE(table.note(7, heartbeats_to_believe, 4 * s)) << "and it stays so";
}

TEST(confirmation_table, what_is_older_than_the_window_does_not_count) {
  confirmation_table table;
  for (int i = 0; i < 20; ++i)
    EXPECT_FALSE(table.note(7, heartbeats_to_believe, i * 2 * s));
}

TEST(confirmation_table, senders_do_not_count_for_each_other) {
  confirmation_table table;
  for (std::uint64_t who = 0; who < 4; ++who)
    EXPECT_FALSE(table.note(who, heartbeats_to_believe, 0));
}

TEST(confirmation_table, a_flood_of_senders_is_bounded_and_pushes_out_who_was_silent_longest) {
  confirmation_table table;
  for (int i = 0; i < 3; ++i)
    (void)table.note(1, heartbeats_to_believe, s + i);
  for (std::uint64_t who = 100; who < 115; ++who)
    (void)table.note(who, heartbeats_to_believe, 0);
  (void)table.note(200, heartbeats_to_believe, 2 * s);
  EXPECT_TRUE(table.note(1, heartbeats_to_believe, 2 * s));
}

} // namespace confirmation_table_test
} // namespace godwit::domain
