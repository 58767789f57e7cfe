#include "io/mavlink/signing/signer.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/messages.hpp"
#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace signer_test {

TEST(mavlink_signer, appends_link_timestamp_and_a_right_hash) {
  signer out(counting_key(), link_id{7}, signing_time{0});
  auto frame = golden_heartbeat(signing::on);
  EXPECT_FALSE(frame.is_complete());
  EXPECT_EQ(out.sign(frame, some_day_ns), signing_time_at(some_day_ns));
  ASSERT_TRUE(frame.is_complete());
  EXPECT_EQ(signature_of(frame.view()).link, link_id{7});
  EXPECT_EQ(signature_of(frame.view()).time, signing_time_at(some_day_ns));
  EXPECT_TRUE(frame_hasher(counting_key()).is_right(frame.view()));
  EXPECT_TRUE(crc_matches(frame.view(), heartbeat::crc_extra)); // it covers the flag
}

TEST(mavlink_signer, a_frame_made_again_at_the_same_moment_gets_a_later_timestamp_and_another_hash) {
  signer out(counting_key(), link_id{0}, signing_time{0});
  auto first = golden_heartbeat(signing::on);
  auto again = golden_heartbeat(signing::on);
  ASSERT_TRUE(out.sign(first, some_day_ns));
  EXPECT_EQ(out.sign(again, some_day_ns), later(signing_time_at(some_day_ns), 1));
  EXPECT_NE(signature_of(first.view()).hash, signature_of(again.view()).hash);
}

TEST(mavlink_signer, without_a_timestamp_left_the_frame_stays_as_it_was) {
  signer out(counting_key(), link_id{0}, max_signing_time);
  auto last = golden_heartbeat(signing::on);
  EXPECT_EQ(out.sign(last, some_day_ns), max_signing_time);
  auto frame = golden_heartbeat(signing::on);
  const auto outcome = out.sign(frame, some_day_ns);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(io::name_of(outcome.error()), "timestamps_used_up");
  EXPECT_FALSE(frame.is_complete());
}

TEST(mavlink_signer, each_of_our_messages_is_signed_and_verified) {
  signer out(counting_key(), link_id{0}, signing_time{0});
  frame_hasher in(counting_key());
  std::mt19937_64 random(1);
  known_messages::for_each([&]<message M>() {
    for (int i = 0; i < 20; ++i) {
      auto frame = encode(random_message<M>(random), sender{1, 191}, 9, signing::on);
      ASSERT_TRUE(out.sign(frame, some_day_ns));
      EXPECT_TRUE(in.is_right(frame.view())) << M::message_id;
      EXPECT_TRUE(crc_matches(frame.view(), M::crc_extra)) << M::message_id;
    }
  });
}

} // namespace signer_test
} // namespace godwit::io::mavlink::test
