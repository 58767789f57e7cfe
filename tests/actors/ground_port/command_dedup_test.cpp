#include "actors/ground_port/command_dedup.hpp"
#include "tests/support/time_units.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

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
} // namespace godwit::ground_port
