#include "actors/vehicle_link/transfer/item_flow.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::vehicle_link::transfer {
namespace item_flow_test {

using godwit::tests::ms;

class item_flow_test : public ::testing::Test {
protected:
  // Everything that may be sent at NOW, in order.
  static std::vector<int> sent_at(item_flow& flow, std::int64_t now_ns) {
    std::vector<int> result;
    while (const auto index = flow.take_sendable(now_ns))
      result.push_back(*index);
    return result;
  }

  static peer_profile ahead(int items) {
    peer_profile result;
    result.first_window = items;
    result.max_window = 32;
    return result;
  }

  round_trip line;
};

TEST_F(item_flow_test, sends_the_first_window_in_order) {
  item_flow flow(100, ahead(4), line);
  EXPECT_EQ(sent_at(flow, ms), (std::vector{0, 1, 2, 3}));
  EXPECT_FALSE(flow.is_all_sent());
}

TEST_F(item_flow_test, a_request_acknowledges_all_before_it_and_opens_the_window) {
  item_flow flow(100, ahead(4), line);
  (void)sent_at(flow, ms);
  EXPECT_TRUE(flow.on_request(3, 31 * ms));
  EXPECT_EQ(flow.wanted(), 3);
  EXPECT_EQ(sent_at(flow, 31 * ms), (std::vector{4, 5, 6, 7, 8, 9})) << "three were taken: 4 + 3 ahead of item 3";
}

TEST_F(item_flow_test, without_permission_to_go_ahead_sends_only_what_is_asked_for) {
  item_flow flow(3, peer_profile{}, line);
  EXPECT_EQ(sent_at(flow, ms), std::vector{0});
  flow.on_request(1, 31 * ms);
  EXPECT_EQ(sent_at(flow, 31 * ms), std::vector{1});
}

TEST_F(item_flow_test, after_silence_sends_the_wanted_item_and_what_follows_in_the_window) {
  item_flow flow(100, ahead(4), line);
  (void)sent_at(flow, ms);
  flow.on_request(1, 31 * ms);
  (void)sent_at(flow, 31 * ms);
  EXPECT_GT(flow.due_ns(), 31 * ms);
  flow.on_silence(flow.due_ns());
  EXPECT_EQ(sent_at(flow, flow.due_ns()), (std::vector{1, 2, 3, 4, 5}));
  EXPECT_EQ(flow.resends(), 5U);
}

TEST_F(item_flow_test, on_a_lossy_line_nothing_is_sent_on_top_of_what_may_be_lost) {
  item_flow flow(100, ahead(4), line);
  (void)sent_at(flow, ms);
  flow.on_request(1, 31 * ms);
  (void)sent_at(flow, 31 * ms);
  const auto again_ns = flow.due_ns();
  flow.on_silence(again_ns);
  const auto burst = sent_at(flow, again_ns);
  ASSERT_GT(burst.size(), 2U);
  const auto answered_ns = again_ns + 30 * ms;
  flow.on_request(2, answered_ns);
  EXPECT_TRUE(sent_at(flow, answered_ns).empty()) << "the rest of the burst is answered now, too, or lost";
  flow.on_request(burst.back() + 1, answered_ns);
  EXPECT_FALSE(sent_at(flow, answered_ns).empty());
}

TEST_F(item_flow_test, the_waits_of_repeated_silence_grow_up_to_a_bound) {
  item_flow flow(100, ahead(4), line);
  (void)sent_at(flow, ms);
  flow.on_request(1, 31 * ms);
  (void)sent_at(flow, 31 * ms);
  std::int64_t last_wait_ns = 0;
  for (int i = 0; i < 30; ++i) {
    const auto now_ns = flow.due_ns();
    flow.on_silence(now_ns);
    (void)sent_at(flow, now_ns);
    const auto wait_ns = flow.due_ns() - now_ns;
    EXPECT_GE(wait_ns, last_wait_ns);
    EXPECT_LE(wait_ns, item_flow::max_wait_ns);
    last_wait_ns = wait_ns;
  }
  EXPECT_EQ(flow.silences(), 30);
}

TEST_F(item_flow_test, into_repeated_silence_everything_is_sent_that_may_be_wanted) {
  item_flow flow(100, ahead(8), line);
  (void)sent_at(flow, ms);
  flow.on_request(1, 31 * ms);
  (void)sent_at(flow, 31 * ms); // up to item 9
  flow.on_silence(100 * ms);
  (void)sent_at(flow, 100 * ms);
  flow.on_silence(200 * ms);
  EXPECT_EQ(sent_at(flow, 200 * ms).back(), 10) << "perhaps all 10 have come, and the requests were lost";
}

TEST_F(item_flow_test, a_repeated_request_is_not_answered_before_an_answer_can_have_come) {
  item_flow flow(100, ahead(2), line);
  (void)sent_at(flow, ms);
  flow.on_request(1, 31 * ms);
  (void)sent_at(flow, 31 * ms);
  flow.on_request(1, 32 * ms);
  EXPECT_TRUE(sent_at(flow, 32 * ms).empty());
  flow.on_request(1, 300 * ms);
  EXPECT_EQ(sent_at(flow, 300 * ms).front(), 1);
}

TEST_F(item_flow_test, a_wrong_item_is_a_sign_of_loss_once) {
  item_flow flow(100, ahead(4), line);
  (void)sent_at(flow, ms);
  flow.on_request(1, 31 * ms);
  (void)sent_at(flow, 31 * ms);
  flow.on_wrong_item(90 * ms);
  EXPECT_EQ(sent_at(flow, 90 * ms).front(), 1);
  flow.on_wrong_item(200 * ms);
  EXPECT_TRUE(sent_at(flow, 200 * ms).empty()) << "what was sent again in vain causes the same sign";
}

TEST_F(item_flow_test, an_older_request_is_believed_only_after_silence) {
  item_flow flow(100, ahead(4), line);
  (void)sent_at(flow, ms);
  flow.on_request(3, 31 * ms);
  (void)sent_at(flow, 31 * ms);
  EXPECT_FALSE(flow.on_request(0, 35 * ms));
  EXPECT_EQ(flow.wanted(), 3);
  flow.on_silence(flow.due_ns());
  EXPECT_EQ(flow.wanted(), 0) << "the vehicle has begun again";
}

TEST_F(item_flow_test, an_acknowledgement_can_not_come_before_all_was_sent_and_a_round_trip_has_passed) {
  item_flow flow(3, ahead(2), line);
  (void)sent_at(flow, ms);
  EXPECT_FALSE(flow.may_be_acknowledged(ms));
  flow.on_request(1, 101 * ms);
  (void)sent_at(flow, 101 * ms);
  EXPECT_TRUE(flow.is_all_sent());
  EXPECT_FALSE(flow.may_be_acknowledged(110 * ms));
  EXPECT_TRUE(flow.may_be_acknowledged(190 * ms));
}

} // namespace item_flow_test
} // namespace godwit::vehicle_link::transfer
