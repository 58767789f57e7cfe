#include "actors/ground_port/start_dedup.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

namespace godwit::ground_port {
namespace start_dedup_test {

using executor::start_verdict;
using io::mavlink::instant;
using kind = start_dedup::kind;

using godwit::tests::ms;
using godwit::tests::s;
constexpr std::int64_t wall_ns = 1'800'000'000 * s;

instant at(std::int64_t ns) { return {ns, wall_ns + ns}; }

vehicle_role::order start_order(float first = 0, std::uint8_t confirmation = 0, io::mavlink::sender from = {255, 190}) {
  return {.from = from, .command = 300, .confirmation = confirmation, .param1 = first};
}

struct asked : start_dedup {
  asked() : start_dedup(std::nullopt, at(0)) {
    record = begin(start_order(), {io::mavlink::mav_result::accepted, 0, 4, {}}, 77, at(0));
  }
  start_record record;
};

std::uint8_t result_of(start_verdict verdict) {
  asked dedup;
  return dedup.resolve({dedup.record.asked.key, verdict, "why"}, at(1 * s))->result;
}

TEST(start_dedup, without_a_start_every_order_is_fresh) {
  const start_dedup dedup(std::nullopt, at(0));
  EXPECT_EQ(dedup.judge(start_order(), 77, at(0)), kind::fresh);
  EXPECT_FALSE(dedup.is_asked());
}

TEST(start_dedup, while_one_is_asked_its_repetition_is_known_and_all_others_find_it_busy) {
  const asked dedup;
  EXPECT_EQ(dedup.judge(start_order(0, 1), 77, at(1 * s)), kind::repeated_while_asked);
  EXPECT_EQ(dedup.judge(start_order(), 77, at(1 * s)), kind::repeated_while_asked);
  EXPECT_EQ(dedup.judge(start_order(2), 77, at(1 * s)), kind::busy);
  EXPECT_EQ(dedup.judge(start_order(0, 0, {254, 190}), 77, at(1 * s)), kind::busy);
}

TEST(start_dedup, the_record_says_what_was_asked_and_until_when_it_may_be_obeyed) {
  const asked dedup;
  EXPECT_EQ(dedup.record.asked.first, 0);
  EXPECT_EQ(dedup.record.asked.last, 4);
  EXPECT_EQ(dedup.record.asked.plan_id, 77U);
  EXPECT_EQ(dedup.record.asked.obey_until_ns, wall_ns + start_dedup::obeyed_within_ns);
}

TEST(start_dedup, each_verdict_of_the_executor_has_its_result) {
  using io::mavlink::mav_result;
  using io::mavlink::number;
  EXPECT_EQ(result_of(start_verdict::started), number(mav_result::accepted));
  EXPECT_EQ(result_of(start_verdict::not_ready), number(mav_result::temporarily_rejected));
  EXPECT_EQ(result_of(start_verdict::too_late), number(mav_result::temporarily_rejected));
  EXPECT_EQ(result_of(start_verdict::disarmed), number(mav_result::denied));
  EXPECT_EQ(result_of(start_verdict::no_such_item), number(mav_result::failed));
  EXPECT_EQ(result_of(start_verdict::failed), number(mav_result::failed));
}

TEST(start_dedup, a_repetition_is_told_from_a_new_start_by_its_confirmation_and_by_time) {
  asked dedup;
  EXPECT_TRUE(dedup.resolve({dedup.record.asked.key, start_verdict::started, ""}, at(1 * s)));
  EXPECT_EQ(dedup.judge(start_order(), 77, at(3 * s - 1)), kind::repeated_after);
  EXPECT_EQ(dedup.judge(start_order(), 77, at(3 * s)), kind::fresh);
  EXPECT_EQ(dedup.judge(start_order(0, 1), 77, at(11 * s - 1)), kind::repeated_after);
  EXPECT_EQ(dedup.judge(start_order(0, 1), 77, at(11 * s)), kind::fresh);
  EXPECT_EQ(dedup.judge(start_order(1), 77, at(1 * s)), kind::fresh);
}

TEST(start_dedup, a_start_of_another_plan_is_no_repetition) {
  asked dedup;
  EXPECT_TRUE(dedup.resolve({dedup.record.asked.key, start_verdict::started, ""}, at(1 * s)));
  EXPECT_EQ(dedup.judge(start_order(), 78, at(1 * s)), kind::fresh);
}

TEST(start_dedup, after_a_refusal_only_a_counted_repetition_gets_the_same_answer) {
  asked dedup;
  EXPECT_TRUE(dedup.resolve({dedup.record.asked.key, start_verdict::disarmed, ""}, at(1 * s)));
  EXPECT_EQ(dedup.judge(start_order(), 77, at(1 * s)), kind::fresh);
  EXPECT_EQ(dedup.judge(start_order(0, 1), 77, at(1 * s)), kind::repeated_after);
}

TEST(start_dedup, silence_is_repeated_so_that_a_late_answer_is_no_second_start) {
  asked dedup;
  EXPECT_TRUE(dedup.on_time(at(20 * s)));
  EXPECT_EQ(dedup.judge(start_order(), 77, at(20 * s)), kind::repeated_after);
}

TEST(start_dedup, an_answer_to_another_start_is_not_taken_and_one_is_taken_once) {
  asked dedup;
  const auto key = dedup.record.asked.key;
  EXPECT_FALSE(dedup.resolve({key + 1, start_verdict::started, ""}, at(1 * s)));
  EXPECT_TRUE(dedup.resolve({key, start_verdict::started, ""}, at(1 * s)));
  EXPECT_FALSE(dedup.resolve({key, start_verdict::failed, ""}, at(1 * s)));
}

TEST(start_dedup, silence_settles_it_and_a_late_answer_corrects_that) {
  asked dedup;
  EXPECT_FALSE(dedup.on_time(at(20 * s - 1)));
  EXPECT_EQ(dedup.next_deadline_ns(), 20 * s);
  const auto silent = dedup.on_time(at(20 * s));
  ASSERT_TRUE(silent);
  EXPECT_FALSE(silent->is_answered);
  EXPECT_EQ(dedup.next_deadline_ns(), std::numeric_limits<std::int64_t>::max());
  const auto late = dedup.resolve({dedup.record.asked.key, start_verdict::started, ""}, at(21 * s));
  ASSERT_TRUE(late);
  EXPECT_TRUE(late->is_correction);
  EXPECT_EQ(late->result, 0);
}

TEST(start_dedup, a_restored_one_waits_for_what_is_left_of_its_patience) {
  const asked before;
  // The next life has another monotonic clock; the time of day goes on.
  start_dedup after(before.record, {500 * s, wall_ns + 1 * s});
  EXPECT_TRUE(after.is_asked());
  EXPECT_EQ(after.next_deadline_ns(), 519 * s);
}

TEST(start_dedup, a_clock_that_was_set_back_makes_nobody_wait_for_longer) {
  const asked before;
  const start_dedup after(before.record, {500 * s, wall_ns - 1'000 * s});
  EXPECT_EQ(after.next_deadline_ns(), 520 * s);
}

TEST(start_dedup, keys_rise) {
  asked dedup;
  const auto key = dedup.record.asked.key;
  EXPECT_TRUE(dedup.resolve({key, start_verdict::started, ""}, at(0)));
  EXPECT_GT(dedup.begin(start_order(1), {}, 77, at(0)).asked.key, key);
}

} // namespace start_dedup_test
} // namespace godwit::ground_port
