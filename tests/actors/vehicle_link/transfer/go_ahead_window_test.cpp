#include "actors/vehicle_link/transfer/go_ahead_window.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::vehicle_link::transfer {
namespace go_ahead_window_test {

using godwit::tests::ms;

// Round trips of a line on which an item takes EACH, of which WINDOW are under way.
std::int64_t round_trip_on(std::int64_t empty_ns, std::int64_t each_ns, int window) {
  return std::max(empty_ns, each_ns * window);
}

TEST(go_ahead_window, doubles_in_a_round_trip_while_the_line_is_not_full) {
  go_ahead_window window(4, 32);
  for (int i = 0; i < 4; ++i)
    window.on_progress(1, 30 * ms, true);
  EXPECT_EQ(window.size(), 8);
}

TEST(go_ahead_window, never_exceeds_its_bound) {
  go_ahead_window window(4, 32);
  for (int i = 0; i < 1'000; ++i)
    window.on_progress(1, 30 * ms, true);
  EXPECT_EQ(window.size(), 32);
}

TEST(go_ahead_window, is_halved_by_a_loss_on_a_line_that_was_full) {
  go_ahead_window window(16, 32);
  for (int i = 0; i < 8; ++i)
    window.on_progress(1, (30 + i * 10) * ms, true);
  const auto before = window.size();
  window.on_loss();
  EXPECT_EQ(window.size(), before / 2);
}

// A loss of each tenth item: bursts of 18 lose little and come through soon.
TEST(go_ahead_window, stays_near_the_items_between_two_losses_on_a_line_that_was_never_full) {
  go_ahead_window window(10, 48);
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 10; ++k)
      window.on_progress(1, 30 * ms, true);
    window.on_loss();
  }
  EXPECT_GE(window.size(), 16);
  EXPECT_LE(window.size(), 20);
}

TEST(go_ahead_window, after_many_losses_holds_the_wanted_item_and_the_next) {
  go_ahead_window window(16, 32);
  for (int i = 0; i < 10; ++i)
    window.on_loss();
  EXPECT_EQ(window.size(), go_ahead_window::min_after_loss);
}

TEST(go_ahead_window, of_a_vehicle_that_takes_no_items_ahead_stays_at_one) {
  go_ahead_window window(1, 1);
  for (int i = 0; i < 10; ++i)
    window.on_progress(1, 30 * ms, true);
  window.on_loss();
  EXPECT_EQ(window.size(), 1);
}

TEST(go_ahead_window, fills_a_slow_line_and_does_not_choke_it) {
  go_ahead_window window(2, 32);
  for (int i = 0; i < 500; ++i)
    window.on_progress(1, round_trip_on(70 * ms, 11 * ms, window.size()), true);
  EXPECT_GE(window.size(), 6) << "the line is full with 6.4";
  EXPECT_LE(window.size(), 10);
}

TEST(go_ahead_window, opens_by_one_in_a_round_trip_when_the_line_has_been_full) {
  go_ahead_window window(2, 32);
  for (int i = 0; i < 500; ++i)
    window.on_progress(1, round_trip_on(70 * ms, 11 * ms, window.size()), true);
  window.on_loss();
  const auto after_loss = window.size();
  for (int i = 0; i < after_loss; ++i)
    window.on_progress(1, 70 * ms, true);
  EXPECT_EQ(window.size(), after_loss + 1);
}

TEST(go_ahead_window, does_not_double_on_answers_of_which_nothing_is_certain) {
  go_ahead_window window(4, 32);
  for (int i = 0; i < 8; ++i)
    window.on_progress(1, 30 * ms, false);
  EXPECT_LE(window.size(), 6);
}

} // namespace go_ahead_window_test
} // namespace godwit::vehicle_link::transfer
