#include "programs/godwit-trace/signature_check.hpp"

#include <gtest/gtest.h>

#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace signature_check_test {

using namespace io::mavlink;

frame_buffer signed_heartbeat(std::uint8_t key_first, std::uint64_t at_us) {
  signer key(counting_key(key_first), link_id{1}, signing_time{0});
  auto frame = encode(heartbeat{}, {1, 1}, 0, signing::on);
  EXPECT_TRUE(key.sign(frame, static_cast<std::int64_t>(at_us) * 1'000));
  return frame;
}

std::uint64_t count_of(const signature_check& check, std::string_view key) {
  for (const auto& each : check.refused())
    if (each.key == key)
      return each.count;
  return 0;
}

TEST(signature_check, without_a_key_everything_passes) {
  signature_check check(std::nullopt);
  EXPECT_TRUE(check.judge(frame_of(heartbeat{}).view(), some_day_us).is_accepted);
  EXPECT_TRUE(check.judge(signed_heartbeat(9, some_day_us).view(), some_day_us).is_accepted);
  EXPECT_TRUE(check.refused().empty());
}

TEST(signature_check, with_a_key_only_what_is_signed_with_it_passes) {
  signature_check check(counting_key());
  EXPECT_TRUE(check.judge(signed_heartbeat(1, some_day_us).view(), some_day_us).is_accepted);
  const auto other = check.judge(signed_heartbeat(2, some_day_us + 1'000).view(), some_day_us);
  EXPECT_FALSE(other.is_accepted);
  EXPECT_EQ(other.sentence, "refused HEARTBEAT of 1/1: its signature is wrong: another key, or changed on the way "
                            "(further ones are only counted)");
  EXPECT_FALSE(check.judge(frame_of(heartbeat{}).view(), some_day_us).is_accepted);
  EXPECT_FALSE(check.judge(signed_heartbeat(1, some_day_us).view(), some_day_us).is_accepted) << "replayed";
  EXPECT_EQ(count_of(check, "refused_bad_signature"), 1U);
  EXPECT_EQ(count_of(check, "refused_unsigned"), 1U);
  EXPECT_EQ(count_of(check, "refused_replayed"), 1U);
}

TEST(signature_check, each_cause_is_said_once) {
  signature_check check(counting_key());
  EXPECT_NE(check.judge(frame_of(heartbeat{}).view(), some_day_us).sentence, "");
  EXPECT_EQ(check.judge(frame_of(heartbeat{}).view(), some_day_us).sentence, "");
  EXPECT_NE(check.judge(signed_heartbeat(2, some_day_us).view(), some_day_us).sentence, "");
  EXPECT_EQ(count_of(check, "refused_unsigned"), 2U);
}

TEST(signature_check, a_clock_that_is_wrong_is_told_as_such) {
  signature_check check(counting_key());
  constexpr std::uint64_t hour_us = 3'600'000'000;
  EXPECT_NE(check.judge(signed_heartbeat(1, some_day_us + hour_us).view(), some_day_us).sentence.find("ahead"),
            std::string::npos);
  EXPECT_NE(check.judge(signed_heartbeat(1, some_day_us - hour_us).view(), some_day_us).sentence.find("old"),
            std::string::npos);
}

} // namespace signature_check_test
} // namespace godwit::trace_tool::test
