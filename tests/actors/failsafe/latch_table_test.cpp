#include <gtest/gtest.h>

#include "actors/failsafe/latch_table.hpp"

namespace latch_table_test {

using namespace godwit::failsafe;

TEST(latch_table, a_rule_is_latched_until_it_is_released) {
  latch_table table({});
  EXPECT_FALSE(table.holds(rule::fence));
  table.set(rule::fence, latch_kind::acted);
  EXPECT_TRUE(table.holds(rule::fence));
  EXPECT_FALSE(table.holds(rule::operator_link));
  table.release(rule::fence);
  EXPECT_FALSE(table.holds(rule::fence));
}

TEST(latch_table, there_is_one_latch_for_each_rule) {
  latch_table table({});
  table.set(rule::fence, latch_kind::left_to_pilot);
  table.set(rule::fence, latch_kind::acted);
  EXPECT_EQ(table.all(), (std::vector<latch>{{rule::fence, latch_kind::acted}}));
}

TEST(latch_table, it_begins_with_what_is_remembered_and_the_end_of_the_flight_frees_all) {
  latch_table table({{rule::fence, latch_kind::acted}, {rule::operator_link, latch_kind::covered}});
  EXPECT_TRUE(table.holds(rule::operator_link));
  table.release_all();
  EXPECT_TRUE(table.all().empty());
}

} // namespace latch_table_test
