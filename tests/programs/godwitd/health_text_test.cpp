#include "programs/godwitd/health_text.hpp"

#include <gtest/gtest.h>

namespace health_text_test {

using namespace godwit::daemon;
using enum godwit::runtime::health_colour;

TEST(health_text, the_line_names_the_worst_and_counts_the_others) {
  EXPECT_EQ(health_in_a_line({}), "all is well");
  EXPECT_EQ(health_in_a_line({{"link", green, ""}}), "all is well");
  EXPECT_EQ(health_in_a_line({{"link", yellow, ""}}), "yellow: link");
  EXPECT_EQ(health_in_a_line({{"a", yellow, "slow"}, {"journal", red, "disk full"}, {"b", green, ""}}),
            "red: journal: disk full; and 1 more");
}

TEST(health_text, a_change_of_colour_and_another_cause_are_news_and_another_number_is_none) {
  EXPECT_TRUE(health_changes({}, {{"a", green, ""}}).empty());
  const auto ill = health_changes({}, {{"a", red, "x"}});
  ASSERT_EQ(ill.size(), 1U);
  EXPECT_EQ(ill[0].sentence, "a is red: x");
  EXPECT_EQ(health_changes({{"a", red, "x for 5 s"}}, {{"a", red, "x for 6 s"}}).size(), 0U) << "the same, longer";
  EXPECT_EQ(health_changes({{"a", red, "x"}}, {{"a", red, "y"}}).size(), 1U) << "another cause";
  const auto well = health_changes({{"a", red, "x"}}, {{"a", green, ""}});
  ASSERT_EQ(well.size(), 1U);
  EXPECT_EQ(well[0].sentence, "a is well again");
}

} // namespace health_text_test
