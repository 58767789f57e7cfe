#include "actors/mission_client/outbox/outbox.hpp"

#include <gtest/gtest.h>

namespace outbox_test {

using namespace godwit::mission_client;

outbox_row row(const std::string& key, destination to, const std::string& mission, std::uint64_t order,
               row_state state = row_state::pending) {
  outbox_row result;
  result.key = key;
  result.to = to;
  result.mission_id = mission;
  result.order = order;
  result.state = state;
  return result;
}

const std::vector<outbox_row>& sample() {
  static const std::vector<outbox_row> rows{row("a", destination::progress, "m", 1),
                                            row("b", destination::waypoint, "m", 2),
                                            row("c", destination::progress, "m", 3, row_state::orphaned),
                                            row("d", destination::progress, "n", 4),
                                            row("e", destination::progress, "m", 5),
                                            row("f", destination::progress, "m", 6, row_state::expired)};
  return rows;
}

TEST(mission_client_outbox, rows_are_found_by_their_key) {
  EXPECT_EQ(find_row(sample(), "d")->mission_id, "n");
  EXPECT_EQ(find_row(sample(), "x"), nullptr);
}

TEST(mission_client_outbox, rows_are_counted_by_state_and_mission) {
  const auto all = count_rows(sample());
  EXPECT_EQ(all.pending, 4U);
  EXPECT_EQ(all.orphaned, 1U);
  EXPECT_EQ(all.expired, 1U);
  EXPECT_EQ(count_rows(sample(), "n").pending, 1U);
}

TEST(mission_client_outbox, a_cut_is_what_waits_in_one_lane_in_order_and_bounded) {
  const auto cut = cut_from(sample(), sample().front(), 100);
  ASSERT_EQ(cut.size(), 2U);
  EXPECT_EQ(cut[0]->key, "a");
  EXPECT_EQ(cut[1]->key, "e");
  EXPECT_EQ(cut_from(sample(), sample().front(), 1).size(), 1U);
  EXPECT_EQ(cut_from(sample(), sample()[4], 100).front()->key, "e");
}

TEST(mission_client_outbox, a_lane_waits_while_it_has_a_pending_row) {
  EXPECT_TRUE(is_waiting(sample(), destination::waypoint, "m"));
  EXPECT_FALSE(is_waiting(sample(), destination::waypoint, "n"));
  EXPECT_FALSE(is_waiting(sample(), destination::tail, "m"));
}

} // namespace outbox_test
