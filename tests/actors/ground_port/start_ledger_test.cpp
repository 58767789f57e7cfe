#include "actors/ground_port/start_ledger.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port {
namespace {

using executor::start_verdict;
using io::mavlink::instant;
using kind = start_ledger::kind;

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t s = 1'000 * ms;
constexpr std::int64_t wall_ns = 1'800'000'000 * s;

instant at(std::int64_t ns) { return {ns, wall_ns + ns}; }

vehicle_role::order order(float first = 0, std::uint8_t confirmation = 0, io::mavlink::sender from = {255, 190}) {
  return {.from = from, .command = 300, .confirmation = confirmation, .param1 = first};
}

struct asked : start_ledger {
  asked() : start_ledger(std::nullopt, at(0)) {
    record = begin(order(), {io::mavlink::mav_result::accepted, 0, 4, {}}, 77, at(0));
  }
  start_record record;
};

std::uint8_t result_of(start_verdict verdict) {
  asked ledger;
  return ledger.settle({ledger.record.asked.key, verdict, "why"}, at(1 * s))->result;
}

TEST(start_ledger, without_a_start_every_order_is_fresh) {
  const start_ledger ledger(std::nullopt, at(0));
  EXPECT_EQ(ledger.judge(order(), 77, at(0)), kind::fresh);
  EXPECT_FALSE(ledger.is_asked());
}

TEST(start_ledger, while_one_is_asked_its_repetition_is_known_and_all_others_find_it_busy) {
  const asked ledger;
  EXPECT_EQ(ledger.judge(order(0, 1), 77, at(1 * s)), kind::repeated_while_asked);
  EXPECT_EQ(ledger.judge(order(), 77, at(1 * s)), kind::repeated_while_asked);
  EXPECT_EQ(ledger.judge(order(2), 77, at(1 * s)), kind::busy);
  EXPECT_EQ(ledger.judge(order(0, 0, {254, 190}), 77, at(1 * s)), kind::busy);
}

TEST(start_ledger, the_record_says_what_was_asked_and_until_when_it_may_be_obeyed) {
  const asked ledger;
  EXPECT_EQ(ledger.record.asked.first, 0);
  EXPECT_EQ(ledger.record.asked.last, 4);
  EXPECT_EQ(ledger.record.asked.plan_id, 77U);
  EXPECT_EQ(ledger.record.asked.obey_until_ns, wall_ns + start_ledger::answer_patience_ns);
}

TEST(start_ledger, each_verdict_of_the_executor_has_its_result) {
  using io::mavlink::mav_result;
  using io::mavlink::number;
  EXPECT_EQ(result_of(start_verdict::started), number(mav_result::accepted));
  EXPECT_EQ(result_of(start_verdict::not_ready), number(mav_result::temporarily_rejected));
  EXPECT_EQ(result_of(start_verdict::too_late), number(mav_result::temporarily_rejected));
  EXPECT_EQ(result_of(start_verdict::disarmed), number(mav_result::denied));
  EXPECT_EQ(result_of(start_verdict::no_such_item), number(mav_result::failed));
  EXPECT_EQ(result_of(start_verdict::failed), number(mav_result::failed));
}

TEST(start_ledger, a_repetition_is_told_from_a_new_start_by_its_confirmation_and_by_time) {
  asked ledger;
  EXPECT_TRUE(ledger.settle({ledger.record.asked.key, start_verdict::started, ""}, at(1 * s)));
  EXPECT_EQ(ledger.judge(order(), 77, at(3 * s - 1)), kind::repeated_after);
  EXPECT_EQ(ledger.judge(order(), 77, at(3 * s)), kind::fresh);
  EXPECT_EQ(ledger.judge(order(0, 1), 77, at(11 * s - 1)), kind::repeated_after);
  EXPECT_EQ(ledger.judge(order(0, 1), 77, at(11 * s)), kind::fresh);
  EXPECT_EQ(ledger.judge(order(1), 77, at(1 * s)), kind::fresh);
}

TEST(start_ledger, a_start_of_another_plan_is_no_repetition) {
  asked ledger;
  EXPECT_TRUE(ledger.settle({ledger.record.asked.key, start_verdict::started, ""}, at(1 * s)));
  EXPECT_EQ(ledger.judge(order(), 78, at(1 * s)), kind::fresh);
}

TEST(start_ledger, after_a_refusal_only_a_counted_repetition_gets_the_same_answer) {
  asked ledger;
  EXPECT_TRUE(ledger.settle({ledger.record.asked.key, start_verdict::disarmed, ""}, at(1 * s)));
  EXPECT_EQ(ledger.judge(order(), 77, at(1 * s)), kind::fresh);
  EXPECT_EQ(ledger.judge(order(0, 1), 77, at(1 * s)), kind::repeated_after);
}

TEST(start_ledger, silence_is_repeated_so_that_a_late_answer_is_no_second_start) {
  asked ledger;
  EXPECT_TRUE(ledger.on_time(at(3 * s)));
  EXPECT_EQ(ledger.judge(order(), 77, at(3 * s)), kind::repeated_after);
}

TEST(start_ledger, an_answer_to_another_start_is_not_taken_and_one_is_taken_once) {
  asked ledger;
  const auto key = ledger.record.asked.key;
  EXPECT_FALSE(ledger.settle({key + 1, start_verdict::started, ""}, at(1 * s)));
  EXPECT_TRUE(ledger.settle({key, start_verdict::started, ""}, at(1 * s)));
  EXPECT_FALSE(ledger.settle({key, start_verdict::failed, ""}, at(1 * s)));
}

TEST(start_ledger, silence_settles_it_and_a_late_answer_corrects_that) {
  asked ledger;
  EXPECT_FALSE(ledger.on_time(at(3 * s - 1)));
  EXPECT_EQ(ledger.next_deadline_ns(), 3 * s);
  const auto silent = ledger.on_time(at(3 * s));
  ASSERT_TRUE(silent);
  EXPECT_FALSE(silent->is_answered);
  EXPECT_EQ(ledger.next_deadline_ns(), std::numeric_limits<std::int64_t>::max());
  const auto late = ledger.settle({ledger.record.asked.key, start_verdict::started, ""}, at(4 * s));
  ASSERT_TRUE(late);
  EXPECT_TRUE(late->is_correction);
  EXPECT_EQ(late->result, 0);
}

TEST(start_ledger, a_restored_one_waits_for_what_is_left_of_its_patience) {
  const asked before;
  // The next life has another monotonic clock; the time of day goes on.
  start_ledger after(before.record, {500 * s, wall_ns + 1 * s});
  EXPECT_TRUE(after.is_asked());
  EXPECT_EQ(after.next_deadline_ns(), 502 * s);
}

TEST(start_ledger, a_clock_that_was_set_back_makes_nobody_wait_for_longer) {
  const asked before;
  const start_ledger after(before.record, {500 * s, wall_ns - 1'000 * s});
  EXPECT_EQ(after.next_deadline_ns(), 503 * s);
}

TEST(start_ledger, keys_rise) {
  asked ledger;
  const auto key = ledger.record.asked.key;
  EXPECT_TRUE(ledger.settle({key, start_verdict::started, ""}, at(0)));
  EXPECT_GT(ledger.begin(order(1), {}, 77, at(0)).asked.key, key);
}

} // namespace
} // namespace godwit::ground_port
