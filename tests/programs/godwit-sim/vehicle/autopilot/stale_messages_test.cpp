#include "programs/godwit-sim/vehicle/autopilot/stale_messages.hpp"

#include <set>

#include <gtest/gtest.h>

namespace godwit::sim {
namespace stale_messages_test {

TEST(stale_messages, is_told_before_or_behind_the_acknowledgement_or_not_at_all) {
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
} // namespace godwit::sim
