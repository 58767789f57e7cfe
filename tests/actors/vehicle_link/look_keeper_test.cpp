#include "actors/vehicle_link/look_keeper.hpp"

#include <gtest/gtest.h>

#include "tests/support/time_units.hpp"

namespace godwit::vehicle_link {
namespace look_keeper_test {

using tests::ms;

command_outcome outcome(command_verdict verdict) {
  command_outcome result;
  result.verdict = verdict;
  return result;
}

// ArduPilot answers, and sends what it was asked for after that.
TEST(look_keeper, a_heartbeat_after_the_answer_is_the_one_that_was_asked_for) {
  look_keeper looks;
  EXPECT_FALSE(looks.begin(7, false, 0));
  ASSERT_TRUE(looks.next_request(0));
  EXPECT_FALSE(looks.on_heartbeat(5 * ms)) << "it may have been sent before";
  EXPECT_FALSE(looks.on_outcome(outcome(command_verdict::accepted), 20 * ms));
  const auto done = looks.on_heartbeat(21 * ms);
  ASSERT_TRUE(done);
  EXPECT_TRUE(done->what.is_seen);
  EXPECT_EQ(done->request_id, 7U);
  EXPECT_EQ(done->what.at_ns, 21 * ms);
}

// PX4 sends what it is asked for, and then answers.
TEST(look_keeper, of_a_px4_the_answer_comes_after_the_heartbeat) {
  look_keeper looks;
  EXPECT_FALSE(looks.begin(7, true, 0));
  ASSERT_TRUE(looks.next_request(0));
  EXPECT_FALSE(looks.on_heartbeat(19 * ms));
  const auto done = looks.on_outcome(outcome(command_verdict::accepted), 20 * ms);
  ASSERT_TRUE(done);
  EXPECT_TRUE(done->what.is_seen);
}

TEST(look_keeper, a_request_that_is_lost_is_repeated) {
  look_keeper looks;
  EXPECT_FALSE(looks.begin(7, false, 0));
  ASSERT_TRUE(looks.next_request(0));
  EXPECT_FALSE(looks.next_request(1'000 * ms)) << "one is under way";
  EXPECT_FALSE(looks.on_outcome(outcome(command_verdict::timed_out), 300 * ms));
  EXPECT_TRUE(looks.next_request(300 * ms));
}

TEST(look_keeper, of_a_vehicle_that_knows_no_request_the_next_heartbeat_counts) {
  look_keeper looks;
  EXPECT_FALSE(looks.begin(7, false, 0));
  ASSERT_TRUE(looks.next_request(0));
  EXPECT_FALSE(looks.on_outcome(outcome(command_verdict::refused), 20 * ms));
  EXPECT_TRUE(looks.on_heartbeat(900 * ms)->what.is_seen);
}

TEST(look_keeper, a_vehicle_that_sends_no_heartbeat_is_not_seen) {
  look_keeper looks;
  EXPECT_FALSE(looks.begin(7, false, 0));
  ASSERT_TRUE(looks.next_request(0));
  EXPECT_FALSE(looks.on_time(look_keeper::gives_up_ms * ms - 1));
  const auto done = looks.on_time(look_keeper::gives_up_ms * ms);
  ASSERT_TRUE(done);
  EXPECT_FALSE(done->what.is_seen);
  EXPECT_FALSE(done->what.reason.empty());
}

TEST(look_keeper, a_newer_look_takes_the_place_of_one_that_waits) {
  look_keeper looks;
  EXPECT_FALSE(looks.begin(7, false, 0));
  const auto before = looks.begin(8, false, 10 * ms);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->request_id, 7U);
  EXPECT_FALSE(before->what.is_seen);
}

// What was in the socket while the process was stopped.
TEST(look_keeper, after_a_stall_neither_the_answer_nor_a_heartbeat_from_before_it_counts) {
  look_keeper looks;
  EXPECT_FALSE(looks.begin(7, true, 0));
  ASSERT_TRUE(looks.next_request(0));
  EXPECT_FALSE(looks.on_heartbeat(2'500 * ms));
  EXPECT_FALSE(looks.on_outcome(outcome(command_verdict::accepted), 2'500 * ms));
  ASSERT_TRUE(looks.next_request(2'500 * ms)) << "it is asked for anew";
  EXPECT_FALSE(looks.on_heartbeat(2'519 * ms));
  const auto done = looks.on_outcome(outcome(command_verdict::accepted), 2'520 * ms);
  ASSERT_TRUE(done);
  EXPECT_TRUE(done->what.is_seen);
}

} // namespace look_keeper_test
} // namespace godwit::vehicle_link
