#include "io/mavlink/signing/verifier.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/messages.hpp"
#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace verifier_test {

constexpr signing_time now = signing_time_at(some_day_ns);

frame_buffer unsigned_radio_status() { return encode(radio_status{}, sender{51, 68}, 0); }

TEST(mavlink_verifier, a_link_without_a_key_is_trusted_and_signatures_are_not_looked_at) {
  verifier in;
  EXPECT_FALSE(in.has_key());
  EXPECT_EQ(in.judge(golden_heartbeat(signing::off).view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.judge(heartbeat_at(now).view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.judge(heartbeat_at(now).view(), now), verdict::accepted_unsigned);
}

TEST(mavlink_verifier, a_link_with_a_key_refuses_what_is_unsigned_but_for_its_short_list) {
  replay_table streams;
  verifier in(counting_key(), streams);
  EXPECT_TRUE(in.has_key());
  EXPECT_EQ(in.judge(golden_heartbeat(signing::off).view(), now), verdict::unsigned_refused);
  EXPECT_EQ(in.judge(unsigned_radio_status().view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.judge(heartbeat_at(now).view(), now), verdict::accepted_signed);
}

TEST(mavlink_verifier, where_unsigned_frames_are_accepted_wrong_signatures_still_are_not) {
  replay_table streams;
  verifier in(counting_key(1), streams, unsigned_policy::accept_all());
  EXPECT_EQ(in.judge(golden_heartbeat(signing::off).view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.judge(heartbeat_at(now).view(), now), verdict::bad_signature);
}

TEST(mavlink_verifier, the_short_list_does_not_excuse_a_wrong_signature) {
  replay_table streams;
  verifier in(counting_key(1), streams);
  const auto frame = signed_at(encode(radio_status{}, sender{51, 68}, 0, signing::on), now);
  EXPECT_EQ(in.judge(frame.view(), now), verdict::bad_signature);
}

TEST(mavlink_verifier, the_signature_is_judged_before_the_time) {
  replay_table streams;
  verifier wrong(counting_key(1), streams);
  EXPECT_EQ(wrong.judge(heartbeat_at(signing_time{1}).view(), now), verdict::bad_signature);
  EXPECT_EQ(wrong.judge(heartbeat_at(later(now, 2 * max_ahead)).view(), now), verdict::bad_signature);
  verifier right(counting_key(), streams);
  EXPECT_EQ(right.judge(heartbeat_at(signing_time{1}).view(), now), verdict::too_old);
  EXPECT_EQ(right.judge(heartbeat_at(later(now, 2 * max_ahead)).view(), now), verdict::too_new);
}

TEST(mavlink_verifier, a_wrong_signature_touches_no_stream) {
  replay_table streams;
  verifier in(counting_key(1), streams);
  for (std::uint8_t system = 0; system < 100; ++system)
    EXPECT_EQ(in.judge(heartbeat_at(now, system).view(), now), verdict::bad_signature);
  EXPECT_EQ(streams.streams(), 0U);
}

TEST(mavlink_verifier, a_frame_recorded_on_one_link_is_not_taken_on_another_with_the_same_key) {
  replay_table streams;
  verifier radio(counting_key(), streams);
  verifier modem(counting_key(), streams);
  const auto frame = heartbeat_at(now);
  EXPECT_EQ(radio.judge(frame.view(), now), verdict::accepted_signed);
  EXPECT_EQ(modem.judge(frame.view(), now), verdict::replayed);
}

TEST(mavlink_verifier, counts_each_verdict) {
  replay_table streams;
  verifier in(counting_key(), streams);
  for (std::uint8_t system = 1; system <= max_signed_streams; ++system)
    ASSERT_EQ(in.judge(heartbeat_at(now, system).view(), now), verdict::accepted_signed);
  EXPECT_EQ(in.judge(heartbeat_at(now, 77).view(), now), verdict::too_many_streams);
  EXPECT_EQ(in.judge(heartbeat_at(now, 1).view(), now), verdict::replayed);
  EXPECT_EQ(in.judge(golden_heartbeat(signing::off).view(), now), verdict::unsigned_refused);
  EXPECT_EQ(in.judge(unsigned_radio_status().view(), now), verdict::accepted_unsigned);
  EXPECT_EQ(in.counts().of(verdict::accepted_signed), max_signed_streams);
  EXPECT_EQ(in.counts().of(verdict::too_many_streams), 1U);
  EXPECT_EQ(in.counts().of(verdict::replayed), 1U);
  EXPECT_EQ(in.counts().of(verdict::unsigned_refused), 1U);
  EXPECT_EQ(in.counts().of(verdict::bad_signature), 0U);
  EXPECT_EQ(in.counts().rejected(), 3U);
  EXPECT_EQ(in.counts().total(), max_signed_streams + 4);
}

TEST(mavlink_verifier, each_verdict_has_a_name_and_its_own_counter) {
  std::size_t place = 0;
  for (const auto& [each, name] : enum_names(verdict{})) {
    EXPECT_EQ(static_cast<std::size_t>(each), place++) << name;
    EXPECT_EQ(io::value_of<verdict>(name), each);
  }
}

} // namespace verifier_test
} // namespace godwit::io::mavlink::test
