#include <set>

#include <gtest/gtest.h>

#include "programs/godwit-sim/vehicle/autopilot/px4_behaviour.hpp"

namespace godwit::sim {

namespace stale_messages_test {

TEST(stale_messages, is_told_before_or_after_the_acknowledgement_or_not_at_all) {
  std::mt19937_64 random(1);
  std::set<std::string> seen;
  for (int i = 0; i < 200; ++i) {
    stale_messages news;
    const auto early = news.on_switch({7, 6}, {.seq = 1, .total = 9, .mission_id = 5}, random);
    const auto late = news.take_late();
    EXPECT_FALSE(early && late) << "once";
    EXPECT_FALSE(news.take_late());
    seen.insert(early ? "before" : late ? "behind" : "not at all");
    const auto& told = early ? early : late;
    if (!told)
      continue;
    if (const auto* current = std::get_if<io::mavlink::mission_current>(&*told)) {
      EXPECT_TRUE(current->seq == 7 || current->seq == 65535);
      EXPECT_EQ(current->mission_id, 5U);
      seen.insert(current->seq == 7 ? "old sequence" : "no sequence");
    } else {
      EXPECT_EQ(std::get<io::mavlink::mission_item_reached>(*told).seq, 6);
      seen.insert("old item");
    }
  }
  EXPECT_EQ(seen.size(), 6U);
}

TEST(stale_messages, never_names_an_item_that_was_not_reached) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    stale_messages news;
    const auto early = news.on_switch({3, std::nullopt}, {.seq = 1, .total = 9, .mission_id = 5}, random);
    const auto late = news.take_late();
    EXPECT_FALSE(early && std::holds_alternative<io::mavlink::mission_item_reached>(*early));
    EXPECT_FALSE(late && std::holds_alternative<io::mavlink::mission_item_reached>(*late));
  }
}

} // namespace stale_messages_test

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
