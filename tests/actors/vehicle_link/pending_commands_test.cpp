#include <gtest/gtest.h>

#include <set>
#include <string>

#include "actors/vehicle_link/pending_commands.hpp"
#include "io/mavlink/enums.hpp"
#include "tests/support/time_units.hpp"

namespace pending_commands_test {

using namespace godwit;
using namespace godwit::vehicle_link;
using io::mavlink::command_ack;
using io::mavlink::mav_result;
using io::mavlink::number;

using godwit::tests::ms;
constexpr std::int64_t timeout_ms = 1'000;

send_command command(std::uint16_t id, std::uint8_t component = 1) {
  send_command result;
  result.command = id;
  result.target_component = component;
  return result;
}

command_ack ack(std::uint16_t id, mav_result result) { return {.command = id, .result = number(result)}; }

TEST(pending_commands, an_ack_goes_to_whoever_sent_that_command) {
  pending_commands dedup;
  EXPECT_FALSE(dedup.take({asker_kind::outside, 7}, command(400), timeout_ms, 0));
  EXPECT_FALSE(dedup.take({asker_kind::outside, 8}, command(300), timeout_ms, 0));
  const auto done = dedup.acknowledge(ack(300, mav_result::accepted), 1, 20 * ms);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->asked_by.request_id, 8U);
  EXPECT_EQ(done->outcome.verdict, command_verdict::accepted);
  EXPECT_EQ(done->outcome.round_trip_us, 20'000);
  EXPECT_EQ(dedup.in_flight(), 1U);
}

TEST(pending_commands, a_refusal_carries_the_result_and_a_sentence) {
  pending_commands dedup;
  (void)dedup.take({}, command(400), timeout_ms, 0);
  const auto done = dedup.acknowledge(ack(400, mav_result::denied), 1, 1 * ms);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome.verdict, command_verdict::refused);
  EXPECT_EQ(done->outcome.result, number(mav_result::denied));
  EXPECT_NE(done->outcome.reason.find("denied"), std::string::npos);
}

TEST(pending_commands, the_same_command_to_the_same_component_waits_only_once) {
  pending_commands dedup;
  EXPECT_FALSE(dedup.take({}, command(400), timeout_ms, 0));
  EXPECT_EQ(dedup.take({}, command(400), timeout_ms, 0), command_verdict::already_running);
  EXPECT_FALSE(dedup.take({}, command(400, 154), timeout_ms, 0));
}

TEST(pending_commands, an_ack_of_another_component_is_not_the_answer) {
  pending_commands dedup;
  (void)dedup.take({}, command(400), timeout_ms, 0);
  EXPECT_FALSE(dedup.acknowledge(ack(400, mav_result::accepted), 154, 1));
  EXPECT_EQ(dedup.unmatched(), 1U);
  EXPECT_EQ(dedup.in_flight(), 1U);
}

TEST(pending_commands, a_second_ack_for_one_command_is_counted_and_ignored) {
  pending_commands dedup;
  (void)dedup.take({}, command(176), timeout_ms, 0);
  EXPECT_TRUE(dedup.acknowledge(ack(176, mav_result::accepted), 1, 1));
  EXPECT_FALSE(dedup.acknowledge(ack(176, mav_result::accepted), 1, 2));
  EXPECT_EQ(dedup.unmatched(), 1U);
}

TEST(pending_commands, no_answer_by_the_deadline_is_an_outcome_of_its_own) {
  pending_commands dedup;
  (void)dedup.take({asker_kind::outside, 3}, command(400), timeout_ms, 0);
  EXPECT_EQ(dedup.next_deadline_ns(), 1'000 * ms);
  EXPECT_TRUE(dedup.expire(1'000 * ms - 1).empty());
  const auto done = dedup.expire(1'000 * ms);
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0].asked_by.request_id, 3U);
  EXPECT_EQ(done[0].outcome.verdict, command_verdict::timed_out);
  EXPECT_FALSE(dedup.next_deadline_ns());
}

TEST(pending_commands, progress_extends_the_deadline_and_not_without_end) {
  pending_commands dedup;
  (void)dedup.take({}, command(241), timeout_ms, 0);
  std::int64_t now = 0;
  for (; now < (max_progress_ms - timeout_ms) * ms; now += 900 * ms) {
    EXPECT_FALSE(dedup.acknowledge(ack(241, mav_result::in_progress), 1, now));
    ASSERT_TRUE(dedup.expire(now).empty());
  }
  (void)dedup.acknowledge(ack(241, mav_result::in_progress), 1, now);
  EXPECT_EQ(dedup.next_deadline_ns(), max_progress_ms * ms);
}

TEST(pending_commands, what_waits_is_bounded) {
  pending_commands dedup;
  for (std::uint16_t i = 0; i < max_commands_in_flight; ++i)
    ASSERT_FALSE(dedup.take({}, command(i), timeout_ms, 0));
  EXPECT_EQ(dedup.take({}, command(1'000), timeout_ms, 0), command_verdict::too_many);
}

TEST(pending_commands, a_restart_of_the_vehicle_ends_all_that_waits) {
  pending_commands dedup;
  (void)dedup.take({}, command(400), timeout_ms, 0);
  (void)dedup.take({}, command(300), timeout_ms, 0);
  const auto done = dedup.end_all(command_verdict::vehicle_restarted, "why");
  ASSERT_EQ(done.size(), 2U);
  EXPECT_EQ(done[1].outcome.verdict, command_verdict::vehicle_restarted);
  EXPECT_EQ(done[1].outcome.reason, "why");
  EXPECT_EQ(dedup.in_flight(), 0U);
}

TEST(pending_commands, every_result_has_its_own_sentence) {
  std::set<std::string> sentences;
  for (int result = 0; result <= 11; ++result)
    sentences.insert(sentence_for_result(static_cast<std::uint8_t>(result)));
  EXPECT_EQ(sentences.size(), 12U);
}

} // namespace pending_commands_test
