#include <gtest/gtest.h>

#include "io/mavlink/scanner.hpp"

namespace godwit::io::mavlink {
namespace sender_table_test {

constexpr sender vehicle{1, 1};

sender_counters after(std::initializer_list<int> sequences) {
  sender_table senders;
  for (const int each : sequences)
    senders.note(vehicle, static_cast<std::uint8_t>(each));
  return senders.all().front();
}

TEST(sender_table, counts_the_frames_that_are_missing_in_between) {
  EXPECT_EQ(after({7, 8, 9}).lost, 0U);
  EXPECT_EQ(after({7, 9, 13}).lost, 4U);
  EXPECT_EQ(after({7, 9, 13}).received, 3U);
}

TEST(sender_table, sequences_go_around) {
  EXPECT_EQ(after({254, 255, 0, 1}).lost, 0U);
  EXPECT_EQ(after({254, 1}).lost, 2U);
}

TEST(sender_table, a_frame_late_or_twice_is_not_a_loss) {
  EXPECT_EQ(after({1, 2, 2, 3}).lost, 0U);
  EXPECT_EQ(after({1, 2, 2, 3}).out_of_order, 1U);
  EXPECT_EQ(after({1, 3, 2, 4}).lost, 1U);
  EXPECT_EQ(after({1, 3, 2, 4}).out_of_order, 1U);
  EXPECT_EQ(after({10, 11, 10, 12, 11, 13}).lost, 0U);
}

TEST(sender_table, a_peer_that_counts_anew_is_followed_after_two_frames) {
  const auto counters = after({100, 101, 0, 1, 2, 3, 4});
  EXPECT_EQ(counters.out_of_order, 2U);
  EXPECT_EQ(counters.lost, 0U);
}

TEST(sender_table, each_component_has_a_count_of_its_own) {
  sender_table senders;
  for (int i = 0; i < 10; ++i) {
    senders.note({1, 1}, static_cast<std::uint8_t>(i));
    senders.note({1, 154}, static_cast<std::uint8_t>(100 + i));
  }
  ASSERT_EQ(senders.all().size(), 2U);
  EXPECT_EQ(senders.all()[0].lost + senders.all()[1].lost, 0U);
  EXPECT_EQ(senders.all()[1].who, (sender{1, 154}));
}

TEST(sender_table, what_was_not_verified_makes_nobody_known) {
  sender_table senders;
  senders.note_unverified(vehicle, 1);
  EXPECT_TRUE(senders.all().empty());
  senders.note(vehicle, 1);
  senders.note_unverified(vehicle, 2);
  senders.note(vehicle, 3);
  EXPECT_EQ(senders.all().front().lost, 0U);
}

TEST(sender_table, a_frame_that_is_not_believed_counts_for_nothing) {
  sender_table senders;
  senders.note(vehicle, 1);
  senders.note(vehicle, 101);
  senders.take_back();
  senders.note({9, 1}, 7);
  senders.take_back();
  senders.take_back(); // of nobody
  senders.note(vehicle, 2);
  ASSERT_EQ(senders.all().size(), 1U) << "and makes nobody known";
  EXPECT_EQ(senders.all().front().lost, 0U);
  EXPECT_EQ(senders.all().front().received, 2U);
}

TEST(sender_table, follows_no_more_senders_than_its_bound) {
  sender_table senders;
  for (std::size_t i = 0; i < 200; ++i)
    senders.note({static_cast<std::uint8_t>(i), 1}, 0);
  EXPECT_EQ(senders.all().size(), sender_table::max_senders);
}

} // namespace sender_table_test
} // namespace godwit::io::mavlink
