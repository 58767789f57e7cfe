#include "programs/godwit-sim/vehicle/autopilot/repeated_reached.hpp"

#include <gtest/gtest.h>

namespace godwit::sim {
namespace repeated_reached_test {

TEST(repeated_reached, says_nothing_before_an_item_was_reached) {
  repeated_reached news;
  EXPECT_EQ(news.next_ns(), never_ns);
  EXPECT_FALSE(news.due(never_ns - 1));
}

TEST(repeated_reached, repeats_each_second_ten_times) {
  repeated_reached news;
  news.reach(3, 0);
  int said = 0;
  for (std::int64_t now_ns = 0; now_ns < 60 * ns_per_s; now_ns += ns_per_s / 4)
    while (const auto sequence = news.due(now_ns)) {
      EXPECT_EQ(*sequence, 3);
      EXPECT_EQ(now_ns, ++said * ns_per_s);
    }
  EXPECT_EQ(said, repeated_reached::max_repetitions);
}

TEST(repeated_reached, the_next_item_takes_the_place_of_the_last) {
  repeated_reached news;
  news.reach(3, 0);
  news.reach(4, ns_per_s / 2);
  EXPECT_FALSE(news.due(ns_per_s));
  EXPECT_EQ(news.due(3 * ns_per_s / 2), 4);
}

TEST(repeated_reached, forgets) {
  repeated_reached news;
  news.reach(3, 0);
  news.forget();
  EXPECT_EQ(news.next_ns(), never_ns);
}

} // namespace repeated_reached_test
} // namespace godwit::sim
