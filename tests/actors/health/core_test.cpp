#include "actors/health/core.hpp"

#include <gtest/gtest.h>

namespace health_core_test {

using namespace godwit::health;

TEST(health_core, the_worst_of_all_parts_counts_and_stands_first) {
  core all;
  EXPECT_TRUE(all.on_board({{"a", colour::green, ""}, {"b", colour::red, "down"}, {"c", colour::yellow, "slow"}}, 10));
  EXPECT_EQ(all.status().worst, colour::red);
  ASSERT_EQ(all.status().parts.size(), 3U);
  EXPECT_EQ(all.status().parts[0].part, "b");
  EXPECT_EQ(all.status().parts[1].part, "c");
  EXPECT_EQ(all.status().parts[2].part, "a");
}

TEST(health_core, a_part_has_its_colour_since_it_took_it_whatever_its_reason_becomes) {
  core all;
  (void)all.on_board({{"a", colour::green, ""}}, 10);
  (void)all.on_board({{"a", colour::yellow, "slow"}}, 20);
  (void)all.on_board({{"a", colour::yellow, "still slow"}}, 30);
  EXPECT_EQ(all.status().parts.front().since_ms, 20);
  EXPECT_EQ(all.status().parts.front().reason, "still slow");
  EXPECT_EQ(all.status().since_ms, 20);
}

TEST(health_core, the_worst_has_its_colour_since_then_whichever_part_it_is) {
  core all;
  (void)all.on_board({{"a", colour::yellow, "slow"}, {"b", colour::green, ""}}, 10);
  (void)all.on_board({{"a", colour::green, ""}, {"b", colour::yellow, "slow"}}, 20);
  EXPECT_EQ(all.status().since_ms, 10);
  (void)all.on_board({{"a", colour::green, ""}, {"b", colour::green, ""}}, 30);
  EXPECT_EQ(all.status().since_ms, 30);
}

TEST(health_core, only_another_colour_or_another_reason_of_what_is_not_well_is_news) {
  core all;
  EXPECT_TRUE(all.on_board({{"a", colour::green, ""}}, 10)) << "the first";
  EXPECT_FALSE(all.on_board({{"a", colour::green, "map: synced"}}, 20));
  EXPECT_FALSE(all.on_board({{"a", colour::green, ""}, {"b", colour::green, ""}}, 30)) << "a part that is well";
  EXPECT_TRUE(all.on_board({{"a", colour::yellow, "3 late"}, {"b", colour::green, ""}}, 40));
  EXPECT_FALSE(all.on_board({{"a", colour::yellow, "4 late"}, {"b", colour::green, ""}}, 50)) << "another number";
  EXPECT_TRUE(all.on_board({{"a", colour::yellow, "lost"}, {"b", colour::green, ""}}, 60));
  EXPECT_TRUE(all.on_board({{"a", colour::green, ""}, {"b", colour::green, ""}}, 70)) << "it is well again";
}

TEST(health_core, what_is_shown_is_bounded) {
  core all;
  std::vector<posted> many(max_parts + 10, posted{"a", colour::green, ""});
  (void)all.on_board(many, 10);
  EXPECT_EQ(all.status().parts.size(), max_parts);
}

} // namespace health_core_test
