#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "actors/ground_port/command_dedup.hpp"
#include "tests/support/time_units.hpp"

namespace godwit::ground_port {

namespace command_dedup_test {

using mavlink::mav_result;

using godwit::tests::ms;
using godwit::tests::s;
constexpr mavlink::sender station{255, 190};
constexpr mavlink::sender other{254, 190};

vehicle_role::order order(float param1 = 0, mavlink::sender from = station) {
  return {.from = from, .command = 193, .param1 = param1};
}

TEST(command_dedup, without_a_word_nothing_is_a_repetition) {
  const command_dedup dedup;
  EXPECT_FALSE(dedup.heard_before(order(), 0));
  EXPECT_TRUE(dedup.may_begin(station, 0));
}

TEST(command_dedup, while_one_is_asked_its_repetition_hears_that_it_is_in_progress) {
  command_dedup dedup;
  (void)dedup.begin(order(), 0);
  EXPECT_EQ(dedup.heard_before(order(), 100 * s), mav_result::in_progress) << "however long it takes";
  auto counted = order();
  counted.confirmation = 2;
  EXPECT_EQ(dedup.heard_before(counted, 0), mav_result::in_progress);
}

TEST(command_dedup, one_word_of_each_station_is_under_way) {
  command_dedup dedup;
  (void)dedup.begin(order(), 0);
  EXPECT_FALSE(dedup.heard_before(order(1), 0));
  EXPECT_FALSE(dedup.may_begin(station, 0));
  EXPECT_FALSE(dedup.heard_before(order(0, other), 0));
  EXPECT_TRUE(dedup.may_begin(other, 0));
}

TEST(command_dedup, the_answer_goes_to_the_order_that_was_asked_and_once) {
  command_dedup dedup;
  const auto first = dedup.begin(order(), 0);
  const auto second = dedup.begin(order(1, other), 0);
  EXPECT_NE(first, second);
  EXPECT_EQ(dedup.resolve(second, mav_result::accepted, 0)->from, other);
  EXPECT_EQ(dedup.resolve(first, mav_result::accepted, 0)->from, station);
  EXPECT_FALSE(dedup.resolve(first, mav_result::failed, 0));
  EXPECT_FALSE(dedup.resolve(99, mav_result::failed, 0));
  EXPECT_EQ(dedup.heard_before(order(), 0), mav_result::accepted);
}

TEST(command_dedup, a_repetition_hears_the_same_answer_for_3_seconds) {
  command_dedup dedup;
  EXPECT_TRUE(dedup.resolve(dedup.begin(order(), 0), mav_result::temporarily_rejected, 1 * s));
  EXPECT_EQ(dedup.heard_before(order(), 4 * s - 1), mav_result::temporarily_rejected);
  EXPECT_FALSE(dedup.heard_before(order(), 4 * s));
  EXPECT_TRUE(dedup.may_begin(station, 4 * s));
}

TEST(command_dedup, another_word_may_begin_as_soon_as_the_one_before_it_is_answered) {
  command_dedup dedup;
  EXPECT_TRUE(dedup.resolve(dedup.begin(order(), 0), mav_result::accepted, 0));
  EXPECT_FALSE(dedup.heard_before(order(1), 0));
  EXPECT_TRUE(dedup.may_begin(station, 0));
  EXPECT_TRUE(dedup.resolve(dedup.begin(order(1), 0), mav_result::accepted, 0));
  EXPECT_FALSE(dedup.heard_before(order(), 0)) << "pause, continue, pause is no repetition";
}

TEST(command_dedup, every_parameter_counts_and_nan_is_the_same_as_itself) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const vehicle_role::order asked{.from = station,
                                  .command = 192,
                                  .is_in_integers = true,
                                  .param1 = nan,
                                  .param4 = nan,
                                  .x = 50,
                                  .y = 36,
                                  .z = 30,
                                  .frame = 3};
  command_dedup dedup;
  (void)dedup.begin(asked, 0);
  EXPECT_TRUE(dedup.heard_before(asked, 0));
  for (const auto& change : std::vector<void (*)(vehicle_role::order&)>{
           [](auto& o) { o.command = 193; }, [](auto& o) { o.is_in_integers = false; }, [](auto& o) { o.frame = 6; },
           [](auto& o) { o.param1 = -1; }, [](auto& o) { o.param2 = 1; }, [](auto& o) { o.param3 = 1; },
           [](auto& o) { o.param4 = 1; }, [](auto& o) { o.x = 50.0000001; }, [](auto& o) { o.y = 36.0000001; },
           [](auto& o) { o.z = 31; }}) {
    auto changed = asked;
    change(changed);
    EXPECT_FALSE(dedup.heard_before(changed, 0));
  }
}

TEST(command_dedup, at_the_bound_a_further_station_waits_until_an_answer_is_forgotten) {
  command_dedup dedup;
  std::vector<std::uint64_t> requests;
  for (std::size_t i = 0; i < command_dedup::max_stations; ++i)
    requests.push_back(dedup.begin(order(0, {static_cast<std::uint8_t>(100 + i), 190}), 0));
  EXPECT_FALSE(dedup.may_begin(station, 100 * s));
  EXPECT_TRUE(dedup.resolve(requests[3], mav_result::accepted, 100 * s));
  EXPECT_FALSE(dedup.may_begin(station, 102 * s));
  EXPECT_TRUE(dedup.may_begin({103, 190}, 102 * s)) << "it has its place";
  EXPECT_TRUE(dedup.may_begin(station, 103 * s));
  (void)dedup.begin(order(0, station), 103 * s);
  EXPECT_FALSE(dedup.may_begin(other, 103 * s));
}

} // namespace command_dedup_test

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
