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
  EXPECT_EQ(dedup.in_flight(), 1U);
}

TEST(pending_commands, a_second_ack_for_one_command_is_ignored) {
  pending_commands dedup;
  (void)dedup.take({}, command(176), timeout_ms, 0);
  EXPECT_TRUE(dedup.acknowledge(ack(176, mav_result::accepted), 1, 1));
  EXPECT_FALSE(dedup.acknowledge(ack(176, mav_result::accepted), 1, 2));
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

send_command moving(std::uint16_t id) {
  auto result = command(id);
  result.copies = copies_of_moving_order;
  return result;
}

TEST(pending_commands, an_order_that_moves_the_vehicle_goes_out_three_times_within_200_ms_and_never_again) {
  pending_commands commands;
  EXPECT_FALSE(commands.take({asker_kind::outside, 7}, moving(400), timeout_ms, 0));
  std::vector<std::int64_t> copies;
  for (std::int64_t now_ns = 0; now_ns < 10'000 * ms; now_ns += 5 * ms)
    for (const auto& each : commands.due_copies(now_ns)) {
      copies.push_back(now_ns / ms);
      EXPECT_EQ(each.confirmation, copies.size());
    }
  EXPECT_EQ(copies, (std::vector<std::int64_t>{80, 160}));
}

TEST(pending_commands, no_copy_goes_out_after_the_answer) {
  pending_commands commands;
  EXPECT_FALSE(commands.take({asker_kind::outside, 7}, moving(400), timeout_ms, 0));
  EXPECT_TRUE(commands.acknowledge(ack(400, mav_result::accepted), 1, 20 * ms));
  EXPECT_TRUE(commands.due_copies(100 * ms).empty());
}

TEST(pending_commands, no_copy_goes_out_after_the_vehicle_has_begun_to_obey) {
  pending_commands commands;
  EXPECT_FALSE(commands.take({asker_kind::outside, 7}, moving(400), timeout_ms, 0));
  EXPECT_FALSE(commands.acknowledge(ack(400, mav_result::in_progress), 1, 20 * ms));
  EXPECT_TRUE(commands.due_copies(100 * ms).empty());
}

// It would come to the vehicle after what a person does about the first.
TEST(pending_commands, on_a_slow_line_there_are_no_copies) {
  pending_commands commands;
  EXPECT_FALSE(commands.take({asker_kind::outside, 1}, command(512), timeout_ms, 0));
  EXPECT_TRUE(commands.acknowledge(ack(512, mav_result::accepted), 1, 300 * ms));
  EXPECT_FALSE(commands.take({asker_kind::outside, 7}, moving(400), timeout_ms, 1'000 * ms));
  EXPECT_TRUE(commands.due_copies(1'900 * ms).empty());
}

} // namespace pending_commands_test
